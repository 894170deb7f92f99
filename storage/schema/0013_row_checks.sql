-- Schema 13: each evaluation says what was scored, so that `recover` knows rows that another program, or a damaged page, has
-- changed. NULL in rows of earlier schemas.

ALTER TABLE evaluation ADD COLUMN row_check INTEGER;
