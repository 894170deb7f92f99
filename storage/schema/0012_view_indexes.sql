-- Schema 12: who raced in an iteration is looked up, so that v_race_matrix reads a store of millions
-- of evaluations once.

CREATE INDEX candidate_of_iteration ON candidate (iteration);
CREATE INDEX elimination_of_iteration ON elimination (iteration);
