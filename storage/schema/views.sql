-- The public schema: documented column by column in docs/storage.md, fixed by
-- tests/storage/views_test.cpp. A change is a new schema version.

CREATE VIEW v_campaign_status AS
SELECT c.name, c.state, c.seed,
       (SELECT count(*) FROM design) AS designs,
       (SELECT count(*) FROM design WHERE state = 3) AS designs_finished,
       (SELECT count(*) FROM design WHERE state = 4) AS designs_stopped,
       (SELECT coalesce(sum(budget), 0) FROM design) AS budget,
       (SELECT coalesce(sum(used), 0) FROM design) AS used,
       (SELECT count(*) FROM candidate) AS candidates,
       (SELECT count(*) FROM evaluation) AS evaluations,
       (SELECT count(*) FROM worker WHERE worker.state = 'connected') AS workers,
       (SELECT count(*) FROM conflict) AS conflicts,
       c.created, c.finished
FROM campaign AS c;

CREATE VIEW v_campaigns AS
SELECT c.id AS campaign, c.name, c.seed, c.digest, c.state,
       (SELECT count(*) FROM design AS d WHERE d.campaign = c.id) AS designs,
       c.created, c.finished, c.deciding, c.file
FROM campaign AS c;

CREATE VIEW v_designs AS
SELECT id AS design, mission, method, repetition, seed,
       CASE state WHEN 0 THEN 'waiting' WHEN 1 THEN 'racing' WHEN 2 THEN 'testing'
                  WHEN 3 THEN 'finished' WHEN 4 THEN 'stopped' END AS state,
       budget, used, iteration, best AS best_candidate,
       CASE WHEN best IS NOT NULL THEN best_mean END AS best_mean, reason, flavour, campaign
FROM design;

CREATE VIEW v_candidates AS
SELECT c.id AS candidate, (c.id - 1) / 1000000 + 1 AS design, (c.id - 1) % 1000000 + 1 AS number,
       c.iteration, c.parent, c.states AS n_states, c.transitions AS n_transitions,
       c.machine AS fsm_config, c.parameters, c.modules,
       coalesce(t.runs, 0) AS runs,
       CASE WHEN t.runs > 0 THEN t.score_sum / t.runs END AS mean,
       x.iteration AS eliminated_in, x.step AS eliminated_at, x.reason AS eliminated_by
FROM candidate AS c
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

CREATE VIEW v_evaluations AS
SELECT 'e' || (e.candidate * 100000 + e.pair)
           || CASE e.purpose WHEN 0 THEN '' WHEN 1 THEN 'l' WHEN 2 THEN 't' WHEN 3 THEN 'a'
                             WHEN 4 THEN 's' ELSE 'v' END AS id,
       (e.candidate - 1) / 1000000 + 1 AS design, e.candidate,
       CASE e.purpose WHEN 0 THEN 'race' WHEN 1 THEN 'look-ahead' WHEN 2 THEN 'test'
                      WHEN 3 THEN 'audit' WHEN 4 THEN 'score' ELSE 'evaluator' END AS purpose,
       e.pair, p.instance, p.seed, e.iteration,
       CASE e.status WHEN 0 THEN 'ok' WHEN 1 THEN 'rejected' END AS status,
       e.score, e.time, e.bound, e.wall_us / 1000.0 AS wall_ms, nullif(e.worker, 0) AS worker, e.attempt,
       s.name AS source, e.purpose <> 1 AND (e.purpose <> 0 OR e.iteration IS NOT NULL) AS used,
       e.state_digest
FROM evaluation AS e
JOIN source AS s ON s.id = e.source
LEFT JOIN pair AS p
  ON p.design = (e.candidate - 1) / 1000000 + 1 AND p.purpose = e.purpose AND p.number = e.pair;

-- Where a targetEvaluator says the costs, its calls for test instances have negative instances.
CREATE VIEW v_design_scores AS
SELECT d.id AS design, d.mission, d.method, d.repetition, d.best AS candidate,
       s.name AS source, CASE e.purpose WHEN 2 THEN 'test' ELSE 'score' END AS purpose, e.pair, p.instance, p.seed, iif(v.pair IS NULL, e.score, v.score) AS score
FROM design AS d
JOIN evaluation AS e ON e.candidate = d.best AND e.purpose IN (2, 4) AND e.score IS NOT NULL
JOIN source AS s ON s.id = e.source
LEFT JOIN pair AS p ON p.design = d.id AND p.purpose = e.purpose AND p.number = e.pair
LEFT JOIN pair AS q
  ON e.purpose = 2 AND q.design = d.id AND q.purpose = 5 AND q.instance = -p.instance AND q.seed = p.seed
LEFT JOIN evaluation AS v
  ON v.candidate = e.candidate AND v.purpose = 5 AND v.pair = q.number
WHERE d.state = 3;

CREATE VIEW v_leaderboard AS
SELECT mission,
       rank() OVER (PARTITION BY mission ORDER BY coalesce(test_mean, best_mean) DESC) AS rank,
       design, method, repetition, candidate, test_mean, test_runs, best_mean AS race_mean
FROM (SELECT d.mission, d.id AS design, d.method, d.repetition, d.best AS candidate, d.best_mean,
             avg(t.score) AS test_mean, count(t.score) AS test_runs
      FROM design AS d
      LEFT JOIN v_design_scores AS t ON t.design = d.id AND t.purpose = 'test'
      WHERE d.state = 3 AND d.best IS NOT NULL
      GROUP BY d.id);

CREATE VIEW v_convergence AS
SELECT e.design, e.iteration, e.rank, e.candidate, e.mean, e.runs AS n,
       s.used AS experiments_used
FROM elite AS e
LEFT JOIN (SELECT design, iteration, max(used) AS used FROM race_step GROUP BY design, iteration)
  AS s ON s.design = e.design AND s.iteration = e.iteration;

-- Who raced in an iteration: its new candidates, the elites of the one before, and, once it has
-- ended, all whom it dropped or kept (postselection takes candidates from anywhere). A candidate is
-- in every step up to the one that dropped it.
CREATE VIEW v_race_matrix AS
WITH racer (design, iteration, candidate) AS (
  SELECT (id - 1) / 1000000 + 1, iteration, id FROM candidate
  UNION
  SELECT design, iteration + 1, candidate FROM elite
  UNION
  SELECT design, iteration, candidate FROM elite
  UNION
  SELECT (candidate - 1) / 1000000 + 1, iteration, candidate FROM elimination
), tried AS (
  SELECT s.design, s.iteration, s.step, s.pair, r.candidate, e.score
  FROM racer AS r
  CROSS JOIN race_step AS s ON s.design = r.design AND s.iteration = r.iteration
  CROSS JOIN evaluation AS e
    ON e.candidate = r.candidate AND e.purpose = 0 AND e.pair = s.pair AND e.iteration IS NOT NULL
  LEFT JOIN elimination AS x ON x.candidate = r.candidate AND x.iteration = r.iteration
  WHERE x.step IS NULL OR x.step >= s.step
)
SELECT t.design, t.iteration, t.step, t.pair, p.instance, p.seed, t.candidate, t.score,
       CASE WHEN t.score IS NOT NULL THEN rank() OVER peers + (count(*) OVER peers - 1) / 2.0 END
         AS rank
FROM tried AS t
LEFT JOIN pair AS p ON p.design = t.design AND p.purpose = 0 AND p.number = t.pair
WINDOW peers AS (PARTITION BY t.design, t.step ORDER BY t.score DESC
                 RANGE BETWEEN CURRENT ROW AND CURRENT ROW);

CREATE VIEW v_parameters AS
SELECT c.id AS candidate, (c.id - 1) / 1000000 + 1 AS design, c.iteration,
       j.key AS parameter, j.value
FROM candidate AS c, json_each(iif(c.parameters = '', '{}', c.parameters)) AS j;

-- Over the winners of finished designs; a module that another winner of the store has counts as 0.
CREATE VIEW v_module_frequency AS
WITH winner AS (
  SELECT d.id AS design, d.mission, d.method, iif(c.modules = '', '{}', c.modules) AS modules
  FROM design AS d JOIN candidate AS c ON c.id = d.best
  WHERE d.state = 3
), held AS (
  SELECT w.design, j.key AS module, j.value AS occurrences
  FROM winner AS w, json_each(w.modules) AS j
)
SELECT w.mission, w.method, m.module,
       avg(coalesce(h.occurrences, 0)) AS avg_occurrences,
       avg(coalesce(h.occurrences, 0) > 0) AS occurrence_rate
FROM winner AS w
CROSS JOIN (SELECT DISTINCT module FROM held) AS m
LEFT JOIN held AS h ON h.design = w.design AND h.module = m.module
GROUP BY w.mission, w.method, m.module;

CREATE VIEW v_eliminations AS
SELECT (x.candidate - 1) / 1000000 + 1 AS design, x.candidate, x.iteration, x.step, s.pair,
       x.rank_sum, x.reason
FROM elimination AS x
LEFT JOIN race_step AS s ON s.design = (x.candidate - 1) / 1000000 + 1 AND s.step = x.step;

CREATE VIEW v_workers AS
SELECT id AS worker, identity, host, pid, slots, build, state, done, failed, first_seen, last_seen,
       job, cpu, client, connections
FROM worker;

CREATE VIEW v_attempts AS
SELECT 'e' || (a.candidate * 100000 + a.pair)
           || CASE a.purpose WHEN 0 THEN '' WHEN 1 THEN 'l' WHEN 2 THEN 't' WHEN 3 THEN 'a'
                             WHEN 4 THEN 's' ELSE 'v' END AS id,
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
           || CASE f.purpose WHEN 0 THEN '' WHEN 1 THEN 'l' WHEN 2 THEN 't' WHEN 3 THEN 'a'
                             WHEN 4 THEN 's' ELSE 'v' END AS id,
       (f.candidate - 1) / 1000000 + 1 AS design, f.candidate,
       CASE f.purpose WHEN 0 THEN 'race' WHEN 1 THEN 'look-ahead' WHEN 2 THEN 'test'
                      WHEN 3 THEN 'audit' WHEN 4 THEN 'score' ELSE 'evaluator' END AS purpose,
       f.pair, p.instance, p.seed, e.iteration, f.attempt, nullif(f.worker, 0) AS worker, w.host,
       f.reason, f.command, f.output, f.errors, f.time AS at
FROM failed AS f
LEFT JOIN evaluation AS e
  ON e.candidate = f.candidate AND e.purpose = f.purpose AND e.pair = f.pair
LEFT JOIN pair AS p
  ON p.design = (f.candidate - 1) / 1000000 + 1 AND p.purpose = f.purpose AND p.number = f.pair
LEFT JOIN worker AS w ON w.id = f.worker;
