-- Schema 4: what a paper needs besides the races. A store may hold designs of several campaigns
-- (merged, imported), and each design says in which flavour its machines are written.

-- The designs of a campaign have the ids designs_before + 1, designs_before + 2, ...
CREATE TABLE campaign_of_several (
  id             INTEGER PRIMARY KEY,
  name           TEXT NOT NULL,
  digest         TEXT NOT NULL,
  deciding       TEXT NOT NULL,
  file           TEXT NOT NULL,
  seed           INTEGER NOT NULL,
  state          TEXT NOT NULL DEFAULT 'running',
  created        TEXT NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%fZ', 'now')),
  finished       TEXT,
  designs_before INTEGER NOT NULL DEFAULT 0
) STRICT;
INSERT INTO campaign_of_several
SELECT id, name, digest, deciding, file, seed, state, created, finished, 0 FROM campaign;
DROP TABLE campaign;
ALTER TABLE campaign_of_several RENAME TO campaign;

ALTER TABLE design ADD COLUMN campaign INTEGER NOT NULL DEFAULT 1;
ALTER TABLE design ADD COLUMN flavour TEXT NOT NULL DEFAULT '';

-- What the texts of candidates have in common (internal/candidate_code.h). A text that is empty
-- where there is a code is made of the code's phrases; candidates of earlier schemas stay as told.
CREATE TABLE phrase (
  id         INTEGER PRIMARY KEY,
  machine    TEXT,
  parameters TEXT,
  modules    TEXT
) STRICT;
ALTER TABLE candidate ADD COLUMN code TEXT;
ALTER TABLE candidate ADD COLUMN module_code TEXT;

CREATE INDEX race_step_of_iteration ON race_step (design, iteration, step);
