-- Schema 6: who answers for a worker: the name of its key and its address, by which it is trusted or
-- not (docs/storage.md).

ALTER TABLE worker ADD COLUMN principal TEXT NOT NULL DEFAULT '';
