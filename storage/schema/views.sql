-- The public schema: documented column by column in docs/storage.md, fixed by
-- tests/storage/views_test.cpp. A change is a new schema version. PURPOSE_... stand for what
-- storage/stored_enums.h says of purposes.

-- Not public: what acts of `extend` have added to designs' budgets.
CREATE VIEW design_extension AS
SELECT design, sum(budget) AS budget
FROM command
WHERE kind = 'extend' AND step IS NOT NULL
GROUP BY design;

-- Ids of candidates are numbered through designs: those of a campaign's designs lie in one range.
CREATE VIEW v_campaign_status AS
SELECT c.name, c.state, c.seed, c.designs, c.designs_finished, c.designs_stopped, c.budget, c.used,
       (SELECT count(*) FROM candidate AS a
        WHERE a.id > c.designs_before * 1000000
          AND a.id <= (c.designs_before + c.designs) * 1000000) AS candidates,
       (SELECT count(*) FROM evaluation AS e
        WHERE e.candidate > c.designs_before * 1000000
          AND e.candidate <= (c.designs_before + c.designs) * 1000000) AS evaluations,
       (SELECT count(*) FROM worker AS w WHERE w.state = 'connected') AS workers,
       (SELECT count(*) FROM conflict AS f
        WHERE f.candidate > c.designs_before * 1000000
          AND f.candidate <= (c.designs_before + c.designs) * 1000000) AS conflicts,
       c.created, c.finished, c.campaign
FROM (SELECT k.id AS campaign, k.name, k.state, k.seed, k.designs_before, k.created, k.finished,
             count(d.id) AS designs, count(nullif(d.state = 3, 0)) AS designs_finished,
             count(nullif(d.state = 4, 0)) AS designs_stopped,
             coalesce(sum(d.budget), 0) + coalesce(sum(x.budget), 0) AS budget,
             coalesce(sum(d.used), 0) AS used
      FROM campaign AS k LEFT JOIN design AS d ON d.campaign = k.id
      LEFT JOIN design_extension AS x ON x.design = d.id
      GROUP BY k.id) AS c;

CREATE VIEW v_campaigns AS
SELECT c.id AS campaign, c.name, c.seed, c.digest, c.state,
       (SELECT count(*) FROM design AS d WHERE d.campaign = c.id) AS designs,
       c.created, c.finished, c.deciding, c.file
FROM campaign AS c;

CREATE VIEW v_designs AS
SELECT id AS design, mission, method, repetition, seed,
       CASE state WHEN 0 THEN 'waiting' WHEN 1 THEN 'racing' WHEN 2 THEN 'testing'
                  WHEN 3 THEN 'finished' WHEN 4 THEN 'stopped' END AS state,
       budget + coalesce((SELECT x.budget FROM design_extension AS x WHERE x.design = design.id), 0)
         AS budget,
       used,
       max(iteration, coalesce((SELECT max(i.number) FROM iteration AS i WHERE i.design = design.id), 0))
         AS iteration,
       best AS best_candidate,
       CASE WHEN best IS NOT NULL AND used > 0 THEN best_mean END AS best_mean, reason, flavour,
       campaign, name
FROM design;

-- Not public: the rows of the table with their texts, made of phrases where they have a code
-- (internal/candidate_code.h). A text costs its time only where it is asked for. json_each gives
-- the pieces in order, and CROSS JOIN keeps them so.
-- The second condition on the design says the same as the first: a query for some designs then
-- reads their candidates alone, and one for some candidates reads these. So in the other views.
CREATE VIEW candidate_text AS
SELECT c.id, d.id AS design, c.iteration, c.parent, c.states, c.transitions,
       CASE WHEN c.code IS NULL OR c.machine <> '' THEN c.machine ELSE
         (SELECT coalesce(group_concat(p.machine || j.value, ' '), '')
          FROM json_each(c.code) AS j
          CROSS JOIN phrase AS p ON p.id = j.key) END AS machine,
       CASE WHEN c.code IS NULL THEN c.parameters ELSE
         (SELECT '{' || group_concat(p.parameters || j.value, ',') || '}'
          FROM json_each(c.code) AS j
          CROSS JOIN phrase AS p ON p.id = j.key) END AS parameters,
       CASE WHEN c.module_code IS NULL THEN c.modules ELSE
         (SELECT '{' || group_concat(p.modules, ',') || '}'
          FROM json_each(c.module_code) AS j
          CROSS JOIN phrase AS p ON p.id = j.value) END AS modules
FROM candidate AS c
JOIN design AS d ON d.id = (c.id - 1) / 1000000 + 1
  AND c.id BETWEEN (d.id - 1) * 1000000 + 1 AND d.id * 1000000;

CREATE VIEW v_candidates AS
SELECT c.id AS candidate, c.design, (c.id - 1) % 1000000 + 1 AS number,
       c.iteration, c.parent, c.states AS n_states, c.transitions AS n_transitions,
       c.machine AS fsm_config, c.parameters, c.modules,
       coalesce(t.runs, 0) AS runs,
       CASE WHEN t.runs > 0 THEN t.score_sum / t.runs END AS mean,
       x.iteration AS eliminated_in, x.step AS eliminated_at, x.reason AS eliminated_by
FROM candidate_text AS c
LEFT JOIN candidate_totals AS t ON t.candidate = c.id
LEFT JOIN elimination AS x ON x.candidate = c.id
  AND x.iteration = (SELECT max(iteration) FROM elimination AS l WHERE l.candidate = c.id);

CREATE VIEW v_iterations AS
SELECT i.design, i.number AS iteration, i.planned, i.budget, i.configurations, i.elites,
       i.soft_restart, i.postselection
FROM iteration AS i;

CREATE VIEW v_race_steps AS
SELECT design, step, iteration, pair, marker, bound, alive_before, alive_after, best, mean_best,
       evaluated, used, statistic, p_value, kendall_w, spearman_rho, qvar
FROM race_step;

-- Not public: a real run with the scoring and the person's word on it that count, and whether its
-- score does: a VALID or DEGRADED one whose robots' centres are known, or what a person said is.
-- A person's word holds for the scoring that the person saw, not for a later one.
CREATE VIEW real_run_now AS
SELECT r.id AS run, r.candidate, r.source, r.mission, r.name, r.recorded, r.duration, r.stored,
       r.key, r.robots, r.videos, s.number AS scoring, s.score, s.verdict AS measured_verdict,
       coalesce(o.verdict, s.verdict) AS verdict, o.who, o.reason, s.biased, s.time AS scored,
       s.program,
       s.score IS NOT NULL AND coalesce(o.verdict, s.verdict) IN ('VALID', 'DEGRADED')
         AND (s.biased = 0 OR o.verdict IS NOT NULL) AS counts
FROM real_run AS r
JOIN real_score AS s
  ON s.run = r.id AND s.number = (SELECT max(l.number) FROM real_score AS l WHERE l.run = r.id)
LEFT JOIN real_override AS o
  ON o.run = r.id AND o.number = (SELECT max(l.number) FROM real_override AS l WHERE l.run = r.id)
  AND o.scoring = s.number;

-- The parts of a UNION ALL have the same affinities, hence the casts: else SQLite would make all of
-- the view where a query joins it.
CREATE VIEW v_evaluations AS
SELECT 'e' || (e.candidate * 100000 + e.pair)
           || PURPOSE_LETTER(e.purpose) AS id,
       d.id AS design, e.candidate,
       PURPOSE_WORD(e.purpose) AS purpose,
       e.pair, p.instance, nullif(p.seed, 0) AS seed, e.iteration,
       CASE e.status WHEN 0 THEN 'ok' WHEN 1 THEN 'rejected' END AS status,
       e.score, e.time, e.bound, e.wall_us / 1000.0 AS wall_ms, nullif(e.worker, 0) AS worker, e.attempt,
       s.name AS source, e.purpose <> 1 AND (e.purpose <> 0 OR e.iteration IS NOT NULL) AS used,
       e.state_digest
FROM evaluation AS e
JOIN design AS d ON d.id = (e.candidate - 1) / 1000000 + 1
  AND e.candidate BETWEEN (d.id - 1) * 1000000 + 1 AND d.id * 1000000
JOIN source AS s ON s.id = e.source
LEFT JOIN pair AS p ON p.design = d.id AND p.purpose = e.purpose AND p.number = e.pair
UNION ALL
SELECT 'r' || r.run, d.id, r.candidate, 'score', CAST(NULL AS INTEGER), CAST(NULL AS INTEGER), NULL,
       CAST(NULL AS INTEGER), 'ok', r.score, CAST(NULL AS REAL), CAST(NULL AS REAL), NULL, NULL,
       CAST(NULL AS INTEGER), r.source, 1, CAST(0 AS INTEGER)
FROM real_run_now AS r
JOIN design AS d ON d.id = (r.candidate - 1) / 1000000 + 1
  AND r.candidate BETWEEN (d.id - 1) * 1000000 + 1 AND d.id * 1000000
WHERE r.counts;

-- Not public: v_design_scores without real runs.
-- Where a targetEvaluator says the costs, its calls for test instances have negative instances.
CREATE VIEW design_score AS
SELECT d.id AS design, d.mission, d.method, d.repetition, d.best AS candidate,
       s.name AS source, PURPOSE_COUNTS_AS(e.purpose) AS purpose, e.pair, p.instance, nullif(p.seed, 0) AS seed,
       iif(v.pair IS NULL, e.score, v.score) AS score
FROM design AS d
JOIN evaluation AS e ON e.candidate = d.best AND e.purpose IN PURPOSES_THAT_COUNT AND e.score IS NOT NULL
JOIN source AS s ON s.id = e.source
LEFT JOIN pair AS p ON p.design = d.id AND p.purpose = e.purpose AND p.number = e.pair
LEFT JOIN pair AS q
  ON e.purpose = 2 AND q.design = d.id AND q.purpose = 5 AND q.instance = -p.instance AND q.seed = p.seed
LEFT JOIN evaluation AS v
  ON v.candidate = e.candidate AND v.purpose = 5 AND v.pair = q.number
WHERE d.state = 3;

CREATE VIEW v_design_scores AS
SELECT design, mission, method, repetition, candidate, source, purpose, pair, instance, seed, score
FROM design_score
UNION ALL
SELECT d.id, d.mission, d.method, d.repetition, r.candidate, r.source, 'score', NULL, NULL, NULL,
       r.score
FROM design AS d
JOIN real_run_now AS r ON r.candidate = d.best
WHERE d.state = 3 AND r.counts;

CREATE VIEW v_leaderboard AS
SELECT mission,
       rank() OVER (PARTITION BY mission ORDER BY coalesce(test_mean, best_mean) DESC) AS rank,
       design, method, repetition, candidate, test_mean, test_runs, best_mean AS race_mean
FROM (SELECT d.mission, d.id AS design, d.method, d.repetition, d.best AS candidate,
             CASE WHEN d.used > 0 THEN d.best_mean END AS best_mean,
             avg(t.score) AS test_mean, count(t.score) AS test_runs
      FROM design AS d
      LEFT JOIN design_score AS t ON t.design = d.id AND t.purpose = 'test'
      WHERE d.state = 3 AND d.best IS NOT NULL
      GROUP BY d.id);

CREATE VIEW v_convergence AS
SELECT e.design, e.iteration, e.rank, e.candidate, e.mean, e.runs AS n,
       (SELECT max(s.used) FROM race_step AS s
        WHERE s.design = e.design AND s.iteration = e.iteration) AS experiments_used
FROM elite AS e;

-- Who raced in an iteration: its new candidates, the elites of the one before, and, once it has
-- ended, all whom it dropped or kept (postselection takes candidates from anywhere). A candidate is
-- in every step up to the one that dropped it.
-- An iteration is found by its first step, in the order of an index, and its racers are one JSON
-- list, whose parts have none in common: so SQLite sorts one iteration at a time for the ranks, in
-- little memory, and a predicate on design, iteration or step (which are the PARTITION) picks some.
-- By default a window ends with the last of equal scores: count(*) is its place, rank() the first's.
CREATE VIEW v_race_matrix AS
WITH tried AS (
  SELECT f.design, f.iteration, s.step, s.pair, r.value AS candidate, e.score
  FROM race_step AS f
  CROSS JOIN json_each((
    SELECT '[' || group_concat(candidate) || ']' FROM (
      SELECT c.id AS candidate FROM candidate AS c
      WHERE c.iteration = f.iteration
        AND c.id BETWEEN (f.design - 1) * 1000000 + 1 AND f.design * 1000000
      UNION ALL
      SELECT k.candidate FROM elite AS k
      WHERE k.design = f.design AND k.iteration = f.iteration - 1
      UNION ALL
      SELECT k.candidate
      FROM elite AS k JOIN candidate AS c ON c.id = k.candidate AND c.iteration <> k.iteration
      WHERE k.design = f.design AND k.iteration = f.iteration
        AND NOT EXISTS (SELECT 1 FROM elite AS b WHERE b.design = f.design
                        AND b.iteration = f.iteration - 1 AND b.candidate = k.candidate)
      UNION ALL
      SELECT x.candidate
      FROM elimination AS x JOIN candidate AS c ON c.id = x.candidate AND c.iteration <> x.iteration
      WHERE x.iteration = f.iteration
        AND x.candidate BETWEEN (f.design - 1) * 1000000 + 1 AND f.design * 1000000
        AND NOT EXISTS (SELECT 1 FROM elite AS b WHERE b.design = f.design
                        AND b.iteration IN (f.iteration - 1, f.iteration)
                        AND b.candidate = x.candidate)))) AS r
  CROSS JOIN race_step AS s ON s.design = f.design AND s.iteration = f.iteration
    AND s.step BETWEEN f.step AND coalesce(
      (SELECT x.step FROM elimination AS x
       WHERE x.candidate = r.value AND x.iteration = f.iteration),
      (SELECT max(l.step) FROM race_step AS l
       WHERE l.design = f.design AND l.iteration = f.iteration))
  CROSS JOIN evaluation AS e
    ON e.candidate = r.value AND e.purpose = 0 AND e.pair = s.pair AND e.iteration IS NOT NULL
  WHERE NOT EXISTS (SELECT 1 FROM race_step AS b WHERE b.design = f.design
                    AND b.iteration = f.iteration AND b.step < f.step)
), ranked AS (
  SELECT t.design, t.iteration, t.step, t.pair, t.candidate, t.score,
         CASE WHEN t.score IS NOT NULL THEN (rank() OVER peers + count(*) OVER peers) / 2.0 END
           AS rank
  FROM tried AS t
  WINDOW peers AS (PARTITION BY t.design, t.iteration, t.step ORDER BY t.score DESC)
)
SELECT t.design, t.iteration, t.step, t.pair, p.instance, p.seed, t.candidate, t.score, t.rank
FROM ranked AS t
LEFT JOIN pair AS p ON p.design = t.design AND p.purpose = 0 AND p.number = t.pair;

CREATE VIEW v_parameters AS
SELECT c.id AS candidate, c.design, c.iteration, j.key AS parameter, j.value
FROM candidate_text AS c, json_each(nullif(c.parameters, '')) AS j;

-- Not public: what the numbers in a machine's text mean. The program puts flavour_name(flavour, kind,
-- number, name) here, made of the tables of its flavours (storage/internal/view_text.cpp): kind is s for
-- behaviours, c for conditions, l for labels.
-- flavour_name

-- Not public: the text of a machine or a tree, and its words as a JSON array: "--a 1 --b 2" is
-- ["a 1","b 2"]. Parameters of programs, which have no flavour, are neither. json_each of one element
-- gives what costs time to make a name, so that it is made once.
CREATE VIEW machine_text AS
SELECT c.id AS candidate, c.design, d.flavour, t.value AS text,
       '["' || replace(substr(t.value, 3), ' --', '","') || '"]' AS words
FROM candidate_text AS c
JOIN design AS d ON d.id = c.design
JOIN json_each(CASE WHEN d.flavour <> '' THEN '["' || c.machine || '"]' ELSE '[]' END) AS t
  ON t.value GLOB '--nstates [0-9]*' OR t.value GLOB '--nroot [0-9]*';

-- Not public: the states to which transitions lead from the first one, between blanks. Targets are
-- numbered without the state that is left: "n1x0 1" leads from state 1 to state 2. It costs ten
-- times what the words cost, so that it is an expression: who does not ask for it does not pay.
CREATE VIEW machine_reach AS
SELECT m.candidate, m.design, m.flavour, m.text, m.words, (
  WITH RECURSIVE reached(state) AS (
    SELECT 0
    UNION
    SELECT 0 + substr(j.value, instr(j.value, ' ')) +
           (0 + substr(j.value, instr(j.value, ' ')) >= r.state)
    FROM reached AS r JOIN json_each(m.words) AS j
      ON j.value GLOB 'n' || r.state || 'x[0-9]*')
  SELECT ' ' || group_concat(state, ' ') || ' ' FROM reached) AS reached
FROM machine_text AS m;

-- A value is read off the text behind its word: 0 + '3.67 --n0 4' is 3.67.
CREATE VIEW v_states AS
SELECT m.candidate, m.design, 0 + substr(j.value, 2) AS state,
       (SELECT n.name FROM flavour_name AS n WHERE n.flavour = m.flavour AND n.kind = 's'
          AND n.number = 0 + substr(j.value, instr(j.value, ' '))) AS behaviour,
       (SELECT 0 + substr(p.value, instr(p.value, ' '))
        FROM json_each(m.words) AS p
        WHERE p.value GLOB '[a-z][a-z]*' AND p.value GLOB '*[a-z]' || (0 + substr(j.value, 2)) || ' *'
       ) AS parameter,
       instr(m.reached, ' ' || (0 + substr(j.value, 2)) || ' ') > 0 AS reachable
FROM machine_reach AS m
JOIN json_each(m.words) AS j ON j.value GLOB 's[0-9]*';

CREATE VIEW v_transitions AS
SELECT t.candidate, t.design, t.state, t.transition, t.jump + (t.jump >= t.state) AS target,
       (SELECT n.name FROM flavour_name AS n WHERE n.flavour = t.flavour AND n.kind = 'c'
          AND n.number = 0 + substr(t.text, instr(t.text, ' --c' || t.place) + 4
                                            + length(t.place))) AS condition,
       CASE WHEN instr(t.text, ' --p' || t.place) > 0
            THEN 0 + substr(t.text, instr(t.text, ' --p' || t.place) + 4 + length(t.place)) END AS p,
       CASE WHEN instr(t.text, ' --w' || t.place) > 0
            THEN 0 + substr(t.text, instr(t.text, ' --w' || t.place) + 4 + length(t.place)) END AS w,
       (SELECT l.name FROM flavour_name AS l WHERE l.flavour = t.flavour AND l.kind = 'l'
          AND instr(t.text, ' --l' || t.place) > 0
          AND l.number = 0 + substr(t.text, instr(t.text, ' --l' || t.place) + 4
                                            + length(t.place))) AS label,
       instr(t.reached, ' ' || t.state || ' ') > 0 AS reachable
FROM (SELECT m.candidate, m.design, m.flavour, m.text, m.reached,
             0 + substr(j.value, 2) AS state,
             0 + substr(j.value, instr(j.value, 'x') + 1) AS transition,
             substr(j.value, 2, instr(j.value, ' ') - 1) AS place,
             0 + substr(j.value, instr(j.value, ' ')) AS jump
      FROM machine_reach AS m JOIN json_each(m.words) AS j ON j.value GLOB 'n[0-9]*x[0-9]*') AS t;

-- Not public: one row for each place of a machine or a tree that has a module. Those of a tree's subtree 1
-- are c10 and a11; all subtrees can be reached. All places need what is reached: it is made once.
CREATE VIEW module_place AS
SELECT m.candidate, m.design, n.name AS module,
       m.text GLOB '--nroot*' OR instr(r.value, ' ' || (0 + substr(j.value, 2)) || ' ') > 0
         AS reachable
FROM machine_reach AS m
JOIN json_each('["' || m.reached || '"]') AS r
JOIN json_each(m.words) AS j ON j.value GLOB 's[0-9]*' OR j.value GLOB 'c[0-9]*x[0-9]*'
  OR j.value GLOB 'a[0-9][0-9] *' OR j.value GLOB 'c[0-9][0-9] *'
LEFT JOIN flavour_name AS n ON n.flavour = m.flavour
  AND n.kind = replace(substr(j.value, 1, 1), 'a', 's')
  AND n.number = 0 + substr(j.value, instr(j.value, ' '));

CREATE VIEW v_modules AS
SELECT candidate, design, module, count(*) AS occurrences, sum(reachable) AS reachable
FROM module_place
GROUP BY candidate, design, module;

-- Not public: the winners of finished designs that are made of modules, which networks are not.
CREATE VIEW winner AS
SELECT id AS design, mission, method, flavour, best AS candidate
FROM design WHERE state = 3 AND best IS NOT NULL AND flavour <> '';

-- Not public: the modules that a winner has.
CREATE VIEW winner_module AS
SELECT w.design, m.module, count(*) AS occurrences, sum(m.reachable) AS reachable
FROM winner AS w CROSS JOIN module_place AS m ON m.candidate = w.candidate
GROUP BY w.design, m.module;

-- A module that another winner of the store has counts as 0, and as NULL where the flavour has no such
-- module.
CREATE VIEW v_module_frequency AS
WITH held AS MATERIALIZED (SELECT design, module, occurrences, reachable FROM winner_module)
SELECT mission, method, module,
       avg(occurrences) AS avg_occurrences, avg(occurrences > 0) AS occurrence_rate,
       avg(reachable) AS avg_reachable, avg(reachable > 0) AS reachable_rate
FROM (
  SELECT w.mission, w.method, m.module,
         CASE WHEN n.name IS NOT NULL THEN coalesce(h.occurrences, 0) END AS occurrences,
         CASE WHEN n.name IS NOT NULL THEN coalesce(h.reachable, 0) END AS reachable
  FROM winner AS w
  CROSS JOIN (SELECT DISTINCT module FROM held) AS m
  LEFT JOIN flavour_name AS n
    ON n.flavour = w.flavour AND n.kind IN ('s', 'c') AND n.name = m.module
  LEFT JOIN held AS h ON h.design = w.design AND h.module = m.module
  WHERE w.design IN (SELECT design FROM held))
GROUP BY mission, method, module;

CREATE VIEW v_eliminations AS
SELECT d.id AS design, x.candidate, x.iteration, x.step, s.pair, x.rank_sum, x.reason
FROM elimination AS x
JOIN design AS d ON d.id = (x.candidate - 1) / 1000000 + 1
  AND x.candidate BETWEEN (d.id - 1) * 1000000 + 1 AND d.id * 1000000
LEFT JOIN race_step AS s ON s.design = d.id AND s.step = x.step;

CREATE VIEW v_workers AS
SELECT id AS worker, identity, host, pid, slots, build, state, done, failed, first_seen, last_seen,
       job, cpu, client, connections, principal
FROM worker;

CREATE VIEW v_attempts AS
SELECT 'e' || (a.candidate * 100000 + a.pair)
           || PURPOSE_LETTER(a.purpose) AS id,
       (a.candidate - 1) / 1000000 + 1 AS design, a.candidate, a.pair, a.attempt,
       nullif(a.worker, 0) AS worker, w.host, a.held_ms, a.outcome, a.time AS at
FROM attempt AS a
LEFT JOIN worker AS w ON w.id = a.worker;

CREATE VIEW v_commands AS
SELECT number, time AS at, who, kind, design, step, nullif(budget, 0) AS budget
FROM command;

-- Every attempt that gave nothing, and every evaluation that is a rejection without one: a program
-- said so, or a simulation could not be had.
CREATE VIEW v_failures AS
WITH failed (candidate, purpose, pair, attempt, worker, reason, command, output, errors, time) AS (
  SELECT candidate, purpose, pair, attempt, worker, reason, command, output, errors, time
  FROM failure
  UNION ALL
  SELECT e.candidate, e.purpose, e.pair, e.attempt, e.worker, 'rejected', NULL, NULL, NULL, NULL
  FROM evaluation AS e
  WHERE e.status <> 0
    AND NOT EXISTS (SELECT 1 FROM failure AS f WHERE f.candidate = e.candidate
                    AND f.purpose = e.purpose AND f.pair = e.pair)
)
SELECT 'e' || (f.candidate * 100000 + f.pair)
           || PURPOSE_LETTER(f.purpose) AS id,
       (f.candidate - 1) / 1000000 + 1 AS design, f.candidate,
       PURPOSE_WORD(f.purpose) AS purpose,
       f.pair, p.instance, p.seed, e.iteration, f.attempt, nullif(f.worker, 0) AS worker, w.host,
       f.reason, f.command, f.output, f.errors, f.time AS at
FROM failed AS f
LEFT JOIN evaluation AS e
  ON e.candidate = f.candidate AND e.purpose = f.purpose AND e.pair = f.pair
LEFT JOIN pair AS p
  ON p.design = (f.candidate - 1) / 1000000 + 1 AND p.purpose = f.purpose AND p.number = f.pair
LEFT JOIN worker AS w ON w.id = f.worker;

CREATE VIEW v_real_runs AS
SELECT 'r' || r.run AS id, r.run, r.name, r.candidate, (r.candidate - 1) / 1000000 + 1 AS design,
       r.mission, r.source, r.score, r.verdict, r.counts, r.measured_verdict,
       r.who AS overridden_by, r.reason, r.biased, r.recorded, r.duration AS duration_s,
       r.robots, r.videos AS cameras, r.scoring AS scorings, r.scored, r.stored, r.program, r.key
FROM real_run_now AS r;

CREATE VIEW v_real_scores AS
SELECT 'r' || s.run AS id, s.run, s.number AS scoring, s.score, s.verdict, s.biased, s.reasons,
       s.time AS at, s.program, s.report
FROM real_score AS s;

CREATE VIEW v_real_overrides AS
SELECT 'r' || o.run AS id, o.run, o.number, o.scoring, o.verdict, o.who, o.reason, o.time AS at
FROM real_override AS o;

CREATE VIEW v_real_videos AS
SELECT 'r' || v.run AS id, v.run, v.number AS video, v.camera, v.file, v.width, v.height, v.frames,
       v.damaged_frames, v.time_source, v.sha256,
       nullif(v.camera_calibration, '') AS camera_calibration,
       nullif(v.place_calibration, '') AS place_calibration
FROM real_video AS v;

CREATE VIEW v_real_robots AS
SELECT 'r' || b.run AS id, b.run, b.robot, b.name, b.tag, b.measured, b.interpolated, b.degraded,
       b.missing, b.longest_gap AS longest_gap_s, b.outliers, b.scale, b.residual AS residual_m,
       b.sigma AS sigma_m, b.sigma_theta AS sigma_rad, b.border AS border_m, b.too_close,
       nullif(b.offset_calibration, '') AS offset_calibration
FROM real_robot AS b;

CREATE VIEW v_real_cycles AS
SELECT 'r' || c.run AS id, c.run, c.cycle, c.cycle / 10.0 AS time_s, c.robot, c.x, c.y, c.theta,
       CASE c.kind WHEN 0 THEN 'measured' WHEN 1 THEN 'interpolated' WHEN 2 THEN 'degraded'
                   WHEN 3 THEN 'missing' END AS kind
FROM real_cycle AS c;

CREATE VIEW v_real_logs AS
SELECT 'r' || l.run AS id, l.run, l.robot, b.name, l.file, nullif(l.state, '') AS state,
       nullif(l.verdict, '') AS verdict, l.reasons, l.stepped, l.held, l.skipped,
       l.clock_offset AS clock_offset_s, l.latency AS latency_s, l.latency_error AS latency_error_s,
       nullif(l.latency_reason, '') AS latency_reason, l.agreement, l.machine_digest, l.host,
       l.program, l.scheduling, l.head
FROM real_log AS l LEFT JOIN real_robot AS b ON b.run = l.run AND b.robot = l.robot;

CREATE VIEW v_real_log_cycles AS
SELECT 'r' || c.run AS id, c.run, c.cycle, c.time AS time_s, c.robot, c.act, c.state,
       c.left_speed AS left_mps, c.right_speed AS right_mps, c.late AS late_ms,
       c.age_proximity AS age_proximity_ms, c.age_ground AS age_ground_ms,
       c.age_neighbours AS age_neighbours_ms, c.age_light AS age_light_ms, c.drawn,
       nullif(c.event, '') AS event, c.clock AS clock_s
FROM real_log_cycle AS c;

CREATE VIEW v_real_samples AS
SELECT 'r' || s.run AS id, s.run, s.number, s.video, s.frame, s.time AS time_s, s.tag,
       s.u0 / 1000.0 AS u0, s.v0 / 1000.0 AS v0, s.u1 / 1000.0 AS u1, s.v1 / 1000.0 AS v1,
       s.u2 / 1000.0 AS u2, s.v2 / 1000.0 AS v2, s.u3 / 1000.0 AS u3, s.v3 / 1000.0 AS v3,
       s.hamming, s.margin, s.robot, s.x, s.y, s.theta,
       CASE WHEN s.robot IS NOT NULL THEN
         CASE s.use WHEN 0 THEN 'used' WHEN 1 THEN 'outlier' WHEN 2 THEN 'duplicate'
                    WHEN 3 THEN 'bad fit' WHEN 4 THEN 'outside' END END AS use
FROM real_sample AS s;

CREATE VIEW v_real_patches AS
SELECT 'r' || p.run AS id, p.run, p.number AS patch, p.x, p.y, nullif(p.width, 0) AS width_m,
       nullif(p.height, 0) AS height_m, nullif(p.radius, 0) AS radius_m, p.color
FROM real_patch AS p;

CREATE VIEW v_real_issues AS
SELECT 'r' || i.run AS id, i.run, i.number, i.code, i.text, nullif(i.robot, '') AS robot,
       i.start AS from_s, i.stop AS to_s
FROM real_issue AS i;

-- Of the latest scoring. A run without rows was scored before checks were recorded.
CREATE VIEW v_real_checks AS
SELECT 'r' || k.run AS id, k.run, k.number, k.name, nullif(k.subject, '') AS subject, k.outcome,
       k.value, k.bound, nullif(k.unit, '') AS unit, k.catches, nullif(k.reason, '') AS reason
FROM real_check AS k;

-- A calibration holds until the next of its kind and subject was made; no end: it still does.
CREATE VIEW v_calibrations AS
SELECT c.kind, c.subject, c.made AS valid_from,
       lead(c.made) OVER (PARTITION BY c.kind, c.subject ORDER BY c.made, c.sha256) AS valid_until,
       c.rms,
       CASE c.kind WHEN 'offset'
         THEN (SELECT count(*) FROM real_robot AS b
               WHERE b.offset_calibration = c.sha256 AND b.name = c.subject)
         ELSE (SELECT count(*) FROM real_video AS v
               WHERE v.camera = c.subject
                 AND c.sha256 IN (v.camera_calibration, v.place_calibration)) END AS uses,
       c.sha256, c.file
FROM calibration AS c;
