-- Schema 3: the cluster. Who a worker is, what became of leases that did not simply end with a
-- result, and what people asked of the campaign (docs/storage.md).

ALTER TABLE worker ADD COLUMN job TEXT NOT NULL DEFAULT '';
ALTER TABLE worker ADD COLUMN cpu TEXT NOT NULL DEFAULT '';
ALTER TABLE worker ADD COLUMN client TEXT NOT NULL DEFAULT '';
ALTER TABLE worker ADD COLUMN connections INTEGER NOT NULL DEFAULT 1;

-- A lease that was lost, expired, returned or timed out, or that was a second copy or an audit.
CREATE TABLE attempt (
  seq       INTEGER PRIMARY KEY,
  time      TEXT NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%fZ', 'now')),
  candidate INTEGER NOT NULL,
  purpose   INTEGER NOT NULL,
  pair      INTEGER NOT NULL,
  attempt   INTEGER NOT NULL,
  worker    INTEGER NOT NULL,
  held_ms   INTEGER NOT NULL,
  outcome   TEXT NOT NULL
) STRICT;
CREATE INDEX attempt_of_evaluation ON attempt (candidate, purpose, pair);

-- design is NULL for the whole campaign; step is NULL until the command acts.
CREATE TABLE command (
  number INTEGER PRIMARY KEY,
  time   TEXT NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%fZ', 'now')),
  who    TEXT NOT NULL,
  kind   TEXT NOT NULL,
  design INTEGER REFERENCES design (id),
  step   INTEGER,
  budget INTEGER NOT NULL
) STRICT;
