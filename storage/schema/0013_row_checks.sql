-- Schema 13, 1: each evaluation says what was scored, so that `recover` knows rows that another program, or a damaged page, has
-- changed. NULL in rows of earlier schemas.

ALTER TABLE evaluation ADD COLUMN row_check INTEGER;

-- Schema 13, 2: what a real run was asked before its score counts, and what could not be asked. Runs
-- that were scored before have no rows here.
CREATE TABLE real_check (
  run     INTEGER NOT NULL REFERENCES real_run (id),
  number  INTEGER NOT NULL,
  name    TEXT NOT NULL,
  subject TEXT NOT NULL,
  outcome TEXT NOT NULL,
  value   REAL,
  bound   REAL,
  unit    TEXT NOT NULL,
  catches TEXT NOT NULL,
  reason  TEXT NOT NULL,
  PRIMARY KEY (run, number)
) STRICT, WITHOUT ROWID;

ALTER TABLE real_run ADD COLUMN checks INTEGER NOT NULL DEFAULT 0;
