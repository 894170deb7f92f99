-- Views of views.sql again, in words of our own programs: in no file, but lent to their connections,
-- which have the functions of internal/machine_parts.h. The same rows, in a fraction of the time.

CREATE VIEW machine_reach AS
SELECT m.candidate, m.design, m.flavour, m.text, m.words, reached_states(m.text) AS reached
FROM machine_text AS m;

CREATE VIEW v_modules AS
SELECT m.candidate, m.design,
       (SELECT n.name FROM flavour_name AS n WHERE n.flavour = m.flavour
          AND n.kind = substr(j.key, 1, 1) AND n.number = 0 + substr(j.key, 2)) AS module,
       0 + j.value AS occurrences, 0 + substr(j.value, instr(j.value, ' ')) AS reachable
FROM machine_text AS m JOIN json_each(module_counts(m.text)) AS j;

CREATE VIEW winner_module AS
SELECT w.design,
       (SELECT n.name FROM flavour_name AS n WHERE n.flavour = m.flavour
          AND n.kind = substr(j.key, 1, 1) AND n.number = 0 + substr(j.key, 2)) AS module,
       0 + j.value AS occurrences, 0 + substr(j.value, instr(j.value, ' ')) AS reachable
FROM winner AS w CROSS JOIN machine_text AS m ON m.candidate = w.candidate
CROSS JOIN json_each(module_counts(m.text)) AS j;
