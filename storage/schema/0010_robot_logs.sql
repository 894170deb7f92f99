-- Schema 10: what the robots themselves wrote down of a real run (docs/storage.md): a row a robot that
-- has a log, and one a control cycle of it. A cycle that was skipped has none.

CREATE TABLE real_log (
  run            INTEGER NOT NULL REFERENCES real_run (id),
  robot          INTEGER NOT NULL,
  file           TEXT NOT NULL,
  machine_digest TEXT NOT NULL,
  host           TEXT NOT NULL,
  program        TEXT NOT NULL,
  scheduling     TEXT NOT NULL,
  clock_offset   REAL,
  state          TEXT NOT NULL,
  verdict        TEXT NOT NULL,
  reasons        TEXT NOT NULL,
  stepped        INTEGER NOT NULL,
  held           INTEGER NOT NULL,
  skipped        INTEGER NOT NULL,
  latency        REAL,
  latency_error  REAL,
  agreement      REAL,
  latency_reason TEXT NOT NULL,
  head           TEXT NOT NULL,
  PRIMARY KEY (run, robot)
) STRICT, WITHOUT ROWID;

-- Ages and lateness are in milliseconds.
CREATE TABLE real_log_cycle (
  run            INTEGER NOT NULL REFERENCES real_run (id),
  cycle          INTEGER NOT NULL,
  robot          INTEGER NOT NULL,
  time           REAL NOT NULL,
  clock          REAL NOT NULL,
  late           REAL NOT NULL,
  act            TEXT NOT NULL,
  state          INTEGER NOT NULL,
  left_speed     REAL NOT NULL,
  right_speed    REAL NOT NULL,
  age_proximity  REAL,
  age_ground     REAL,
  age_neighbours REAL,
  age_light      REAL,
  drawn          INTEGER NOT NULL,
  event          TEXT NOT NULL,
  PRIMARY KEY (run, cycle, robot)
) STRICT, WITHOUT ROWID;

ALTER TABLE real_run ADD COLUMN logs INTEGER NOT NULL DEFAULT 0;
ALTER TABLE real_run ADD COLUMN log_cycles INTEGER NOT NULL DEFAULT 0;
