-- Schema 5: real runs, filmed from above (docs/storage.md). They are no part of a campaign's answer.

-- A calibration file, once for each text of a camera or robot. It holds from `made` until the next
-- one of the same kind and subject was made.
CREATE TABLE calibration (
  sha256  TEXT NOT NULL,
  kind    TEXT NOT NULL,
  subject TEXT NOT NULL,
  made    TEXT NOT NULL,
  rms     REAL NOT NULL,
  file    TEXT NOT NULL,
  PRIMARY KEY (sha256, kind, subject)
) STRICT, WITHOUT ROWID;

-- videos to cycles: how many rows the run has in the tables of its parts. The long texts are the last
-- columns, so that lists need not read them.
CREATE TABLE real_run (
  id           INTEGER PRIMARY KEY,
  candidate    INTEGER REFERENCES candidate (id),
  key          TEXT NOT NULL UNIQUE,
  source       TEXT NOT NULL,
  mission      TEXT NOT NULL,
  name         TEXT NOT NULL,
  recorded     TEXT NOT NULL,
  duration     REAL NOT NULL,
  stored       TEXT NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%fZ', 'now')),
  videos       INTEGER NOT NULL DEFAULT 0,
  samples      INTEGER NOT NULL DEFAULT 0,
  looks        INTEGER NOT NULL DEFAULT 0,
  robots       INTEGER NOT NULL DEFAULT 0,
  patches      INTEGER NOT NULL DEFAULT 0,
  cycles       INTEGER NOT NULL DEFAULT 0,
  mission_file TEXT NOT NULL,
  arena_file   TEXT NOT NULL,
  log          TEXT NOT NULL
) STRICT;
CREATE INDEX real_run_of_candidate ON real_run (candidate);

-- frame_times is a JSON array of seconds.
CREATE TABLE real_video (
  run                INTEGER NOT NULL REFERENCES real_run (id),
  number             INTEGER NOT NULL,
  camera             TEXT NOT NULL,
  file               TEXT NOT NULL,
  sha256             TEXT NOT NULL,
  time_source        TEXT NOT NULL,
  width              INTEGER NOT NULL,
  height             INTEGER NOT NULL,
  frames             INTEGER NOT NULL,
  damaged_frames     INTEGER NOT NULL,
  camera_calibration TEXT NOT NULL,
  place_calibration  TEXT NOT NULL,
  frame_times        TEXT NOT NULL,
  PRIMARY KEY (run, number)
) STRICT, WITHOUT ROWID;

CREATE TABLE real_robot (
  run                INTEGER NOT NULL REFERENCES real_run (id),
  robot              INTEGER NOT NULL,
  name               TEXT NOT NULL,
  tag                INTEGER NOT NULL,
  offset_calibration TEXT NOT NULL,
  measured           INTEGER NOT NULL,
  interpolated       INTEGER NOT NULL,
  degraded           INTEGER NOT NULL,
  missing            INTEGER NOT NULL,
  longest_gap        REAL NOT NULL,
  outliers           INTEGER NOT NULL,
  scale              REAL NOT NULL,
  residual           REAL NOT NULL,
  sigma              REAL NOT NULL,
  sigma_theta        REAL NOT NULL,
  border             REAL,
  too_close          INTEGER NOT NULL,
  PRIMARY KEY (run, robot)
) STRICT, WITHOUT ROWID;

-- Corners are in 1/1000 of a pixel. A tag that is no robot's has neither robot nor pose.
CREATE TABLE real_sample (
  run     INTEGER NOT NULL REFERENCES real_run (id),
  number  INTEGER NOT NULL,
  video   INTEGER NOT NULL,
  frame   INTEGER NOT NULL,
  time    REAL NOT NULL,
  tag     INTEGER NOT NULL,
  u0      INTEGER NOT NULL,
  v0      INTEGER NOT NULL,
  u1      INTEGER NOT NULL,
  v1      INTEGER NOT NULL,
  u2      INTEGER NOT NULL,
  v2      INTEGER NOT NULL,
  u3      INTEGER NOT NULL,
  v3      INTEGER NOT NULL,
  hamming INTEGER NOT NULL,
  margin  REAL NOT NULL,
  robot   INTEGER,
  x       REAL,
  y       REAL,
  theta   REAL,
  use     INTEGER NOT NULL,
  PRIMARY KEY (run, number)
) STRICT, WITHOUT ROWID;

CREATE TABLE real_reference (
  run    INTEGER NOT NULL REFERENCES real_run (id),
  number INTEGER NOT NULL,
  video  INTEGER NOT NULL,
  time   REAL NOT NULL,
  tag    INTEGER NOT NULL,
  u0     INTEGER NOT NULL,
  v0     INTEGER NOT NULL,
  u1     INTEGER NOT NULL,
  v1     INTEGER NOT NULL,
  u2     INTEGER NOT NULL,
  v2     INTEGER NOT NULL,
  u3     INTEGER NOT NULL,
  v3     INTEGER NOT NULL,
  frames INTEGER NOT NULL,
  PRIMARY KEY (run, number)
) STRICT, WITHOUT ROWID;

-- A rectangle, or a disc where there is a radius.
CREATE TABLE real_patch (
  run    INTEGER NOT NULL REFERENCES real_run (id),
  number INTEGER NOT NULL,
  color  TEXT NOT NULL,
  x      REAL NOT NULL,
  y      REAL NOT NULL,
  width  REAL NOT NULL,
  height REAL NOT NULL,
  radius REAL NOT NULL,
  PRIMARY KEY (run, number)
) STRICT, WITHOUT ROWID;

CREATE TABLE real_cycle (
  run   INTEGER NOT NULL REFERENCES real_run (id),
  cycle INTEGER NOT NULL,
  robot INTEGER NOT NULL,
  x     REAL NOT NULL,
  y     REAL NOT NULL,
  theta REAL NOT NULL,
  kind  INTEGER NOT NULL,
  PRIMARY KEY (run, cycle, robot)
) STRICT, WITHOUT ROWID;

CREATE TABLE real_issue (
  run          INTEGER NOT NULL REFERENCES real_run (id),
  number       INTEGER NOT NULL,
  code         TEXT NOT NULL,
  text         TEXT NOT NULL,
  robot        TEXT NOT NULL,
  start        REAL,
  stop         REAL,
  of_observing INTEGER NOT NULL,
  PRIMARY KEY (run, number)
) STRICT, WITHOUT ROWID;

-- Every scoring of a run; the last one counts.
CREATE TABLE real_score (
  run     INTEGER NOT NULL REFERENCES real_run (id),
  number  INTEGER NOT NULL,
  score   REAL,
  verdict TEXT NOT NULL,
  biased  INTEGER NOT NULL,
  time    TEXT NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%fZ', 'now')),
  program TEXT NOT NULL,
  reasons TEXT NOT NULL,
  report  TEXT NOT NULL,
  PRIMARY KEY (run, number)
) STRICT, WITHOUT ROWID;

-- What people said; the last word counts above any scoring.
CREATE TABLE real_override (
  run     INTEGER NOT NULL REFERENCES real_run (id),
  number  INTEGER NOT NULL,
  scoring INTEGER NOT NULL,
  verdict TEXT NOT NULL,
  who     TEXT NOT NULL,
  reason  TEXT NOT NULL,
  time    TEXT NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%fZ', 'now')),
  PRIMARY KEY (run, number)
) STRICT, WITHOUT ROWID;
