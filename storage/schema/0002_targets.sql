-- Schema 2: programs as targets. A store of schema 1 gets these by migration, a new one right after
-- the first file, so that both have the same columns in the same order.

-- Of a target's run: the time that it said, and the bound on it; NULL where there is none.
ALTER TABLE evaluation ADD COLUMN time REAL;
ALTER TABLE evaluation ADD COLUMN bound REAL;
ALTER TABLE iteration ADD COLUMN postselection INTEGER NOT NULL DEFAULT 0;
ALTER TABLE race_step ADD COLUMN bound REAL;

-- A candidate can be dropped again, in the race after the last (postselection).
CREATE TABLE elimination_by_iteration (
  candidate INTEGER NOT NULL REFERENCES candidate (id),
  iteration INTEGER NOT NULL,
  step      INTEGER NOT NULL,
  rank_sum  REAL NOT NULL,
  reason    TEXT NOT NULL,
  PRIMARY KEY (candidate, iteration)
) STRICT, WITHOUT ROWID;
INSERT INTO elimination_by_iteration SELECT candidate, iteration, step, rank_sum, reason
FROM elimination;
DROP TABLE elimination;
ALTER TABLE elimination_by_iteration RENAME TO elimination;

-- What programs did that gave no score (docs/storage.md).
CREATE TABLE failure (
  seq       INTEGER PRIMARY KEY,
  time      TEXT NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%fZ', 'now')),
  candidate INTEGER NOT NULL,
  purpose   INTEGER NOT NULL,
  pair      INTEGER NOT NULL,
  attempt   INTEGER NOT NULL,
  worker    INTEGER NOT NULL,
  reason    TEXT NOT NULL,
  command   TEXT NOT NULL,
  output    TEXT NOT NULL,
  errors    TEXT NOT NULL
) STRICT;
