-- Schema 1: the tables of a store; later files add to them. They may change between versions; the views (views.sql) are what
-- people and scripts read. Columns are explained in docs/storage.md.
--
-- Enumerations are stored with the numbers of storage/rows.h. 64-bit digests are stored as signed
-- integers of the same bits. An id of 0 in a row ("none") is NULL here.

CREATE TABLE meta (
  key   TEXT PRIMARY KEY,
  value TEXT NOT NULL
) STRICT, WITHOUT ROWID;

CREATE TABLE campaign (
  id       INTEGER PRIMARY KEY CHECK (id = 1),
  name     TEXT NOT NULL,
  digest   TEXT NOT NULL,
  deciding TEXT NOT NULL,
  file     TEXT NOT NULL,
  seed     INTEGER NOT NULL,
  state    TEXT NOT NULL DEFAULT 'running',
  created  TEXT NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%fZ', 'now')),
  finished TEXT
) STRICT;

CREATE TABLE design (
  id         INTEGER PRIMARY KEY,
  mission    TEXT NOT NULL,
  method     TEXT NOT NULL,
  repetition INTEGER NOT NULL,
  seed       INTEGER NOT NULL,
  budget     INTEGER NOT NULL,
  state      INTEGER NOT NULL DEFAULT 0,
  used       INTEGER NOT NULL DEFAULT 0,
  iteration  INTEGER NOT NULL DEFAULT 0,
  best       INTEGER REFERENCES candidate (id),
  best_mean  REAL NOT NULL DEFAULT 0,
  reason     TEXT NOT NULL DEFAULT ''
) STRICT;

CREATE TABLE iteration (
  design         INTEGER NOT NULL REFERENCES design (id),
  number         INTEGER NOT NULL,
  planned        INTEGER NOT NULL,
  budget         INTEGER NOT NULL,
  configurations INTEGER NOT NULL,
  elites         INTEGER NOT NULL,
  soft_restart   INTEGER NOT NULL,
  model_digest   INTEGER NOT NULL,
  PRIMARY KEY (design, number)
) STRICT, WITHOUT ROWID;

-- Written once. What changes with every evaluation is in candidate_totals, so that the long texts
-- are not written again and again.
CREATE TABLE candidate (
  id          INTEGER PRIMARY KEY,  -- (design - 1) * 1,000,000 + number in the design, from 1
  iteration   INTEGER NOT NULL,
  parent      INTEGER REFERENCES candidate (id),
  states      INTEGER NOT NULL,
  transitions INTEGER NOT NULL,
  modules     TEXT NOT NULL,
  machine     TEXT NOT NULL,
  parameters  TEXT NOT NULL
) STRICT;

CREATE TABLE candidate_totals (
  candidate     INTEGER PRIMARY KEY REFERENCES candidate (id),
  runs          INTEGER NOT NULL,
  score_sum     REAL NOT NULL,
  score_squares REAL NOT NULL
) STRICT;

CREATE TABLE pair (
  design   INTEGER NOT NULL REFERENCES design (id),
  purpose  INTEGER NOT NULL,
  number   INTEGER NOT NULL,
  instance INTEGER NOT NULL,
  seed     INTEGER NOT NULL,
  PRIMARY KEY (design, purpose, number)
) STRICT, WITHOUT ROWID;

CREATE TABLE source (
  id   INTEGER PRIMARY KEY,
  name TEXT NOT NULL UNIQUE
) STRICT;

-- score is NULL when the evaluation was rejected; iteration is NULL outside races and when the race
-- did not want the evaluation.
CREATE TABLE evaluation (
  candidate    INTEGER NOT NULL REFERENCES candidate (id),
  purpose      INTEGER NOT NULL,
  pair         INTEGER NOT NULL,
  iteration    INTEGER,
  status       INTEGER NOT NULL,
  score        REAL,
  state_digest INTEGER NOT NULL,
  source       INTEGER NOT NULL,
  wall_us      INTEGER NOT NULL,
  worker       INTEGER NOT NULL,
  attempt      INTEGER NOT NULL,
  PRIMARY KEY (candidate, purpose, pair)
) STRICT, WITHOUT ROWID;

CREATE TABLE race_step (
  design       INTEGER NOT NULL REFERENCES design (id),
  step         INTEGER NOT NULL,
  iteration    INTEGER NOT NULL,
  pair         INTEGER NOT NULL,
  marker       TEXT NOT NULL,
  evaluated    INTEGER NOT NULL,
  alive_before INTEGER NOT NULL,
  alive_after  INTEGER NOT NULL,
  best         INTEGER REFERENCES candidate (id),
  mean_best    REAL NOT NULL,
  used         INTEGER NOT NULL,
  statistic    REAL,
  p_value      REAL,
  kendall_w    REAL,
  spearman_rho REAL,
  qvar         REAL,
  digest       INTEGER NOT NULL,
  PRIMARY KEY (design, step)
) STRICT, WITHOUT ROWID;

CREATE TABLE elimination (
  candidate INTEGER PRIMARY KEY REFERENCES candidate (id),
  iteration INTEGER NOT NULL,
  step      INTEGER NOT NULL,
  rank_sum  REAL NOT NULL,
  reason    TEXT NOT NULL
) STRICT;

CREATE TABLE elite (
  design    INTEGER NOT NULL REFERENCES design (id),
  iteration INTEGER NOT NULL,
  rank      INTEGER NOT NULL,
  candidate INTEGER NOT NULL REFERENCES candidate (id),
  mean      REAL NOT NULL,
  runs      INTEGER NOT NULL,
  PRIMARY KEY (design, iteration, rank)
) STRICT, WITHOUT ROWID;

CREATE TABLE worker (
  id         INTEGER PRIMARY KEY,
  identity   TEXT NOT NULL,
  host       TEXT NOT NULL,
  pid        INTEGER NOT NULL,
  slots      INTEGER NOT NULL,
  build      TEXT NOT NULL,
  state      TEXT NOT NULL,
  done       INTEGER NOT NULL,
  failed     INTEGER NOT NULL,
  first_seen TEXT NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%fZ', 'now')),
  last_seen  TEXT NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%fZ', 'now'))
) STRICT;

CREATE TABLE conflict (
  candidate          INTEGER NOT NULL,
  purpose            INTEGER NOT NULL,
  pair               INTEGER NOT NULL,
  kept_score         REAL NOT NULL,
  other_score        REAL NOT NULL,
  other_state_digest INTEGER NOT NULL,
  other_worker       INTEGER NOT NULL,
  time               TEXT NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%fZ', 'now')),
  PRIMARY KEY (candidate, purpose, pair, other_state_digest, other_score)
) STRICT, WITHOUT ROWID;

CREATE TABLE event (
  seq      INTEGER PRIMARY KEY,
  time     TEXT NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%fZ', 'now')),
  severity TEXT NOT NULL,
  kind     TEXT NOT NULL,
  text     TEXT NOT NULL
) STRICT;
