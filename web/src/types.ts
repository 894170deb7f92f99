// Answers of the HTTP API (docs/http-api.md). The id of a single thing is a text with a letter
// ("d3"); ids in columns are numbers. Times ending in _s are seconds; other times are UTC texts.

export interface Design {
  id: string;
  mission: string;
  method: string;
  repetition: number;
  state: "waiting" | "racing" | "testing" | "finished" | "stopped" | "interrupted";
  used: number;
  budget: number;
  /// Experiments that its race may still use; 0 when it has ended.
  left: number;
  iteration: number;
  alive: number | null;
  best: string | null;
  /// From its race.
  best_mean: number | null;
  /// From the winner's tests; null before they are done, or if there are none.
  test_mean: number | null;
  test_runs: number;
  paused: boolean;
  /// Changes whenever data of the design change.
  version: number;
  stage?: string;
  search?: string;
  /// The name of its campaign, in a store of several campaigns.
  campaign?: string;
}

export interface Campaign {
  c: string;
  name: string;
  store: string;
  digest: string;
  state: string;
  used: number;
  budget: number;
  left: number;
  eta_s: number | null;
  /// Why its store cannot be written; empty if it can.
  trouble: string;
  last_event: number;
  may_act: boolean;
  designs: Design[];
}

export interface SlotTimes {
  slots_s: number;
  busy_s: number;
  idle_s: Record<string, number>;
}

/// As /status, without campaigns and fleet.
export interface Status {
  workers: number;
  slots: number;
  ready: number;
  leased: number;
  credit: number;
  done: number;
  rejected: number;
  failed: number;
  requeued: number;
  expired: number;
  duplicates: number;
  conflicts: number;
  unknown: number;
  unleased: number;
  quarantined: number;
  lost_workers: number;
  reconnects: number;
  malformed: number;
  uncommitted: number;
  gone_workers: number;
  uptime_s: number;
  evaluations_per_s: number;
  used_per_s: number;
  trouble: string;
  insecure_plaintext: boolean;
  refused: Record<string, number>;
  launcher: { name: string; wanted: number; running: number; pending: number; waits_for: string; note: string };
  eta_s: number | null;
  slot_times: SlotTimes;
  slot_times_last_minute: SlotTimes;
}

export interface Live {
  v: number;
  boot: string;
  now: string;
  host: string;
  user: string;
  pid: number;
  version: string;
  engine: number | string;
  may_act: boolean;
  running: boolean;
  status: Status | null;
  /// Problems that a person should know about, worst first, and the page that shows them: "c1/d3".
  looks: { text: string; page: string }[];
  campaigns: Campaign[];
}

export interface Worker {
  number: number;
  state: string;
  host: string;
  job: string;
  client: string;
  slots: number;
  held: number;
  running: number;
  done: number;
  failed: number;
  connections: number;
  done_per_s: number;
  busy: number;
  last_heard_s: number;
}

/// Workers that get no work until a person forgives the key and address responsible for them.
export interface Quarantine {
  who: string;
  reason: string;
  since: string;
  /// The number of a single worker of `who`; 0: all of its workers.
  worker: number;
  workers: number;
}

export type Cell = string | number | null;

export type Row = Record<string, Cell>;

/// Rows of a view, by column.
export type Columns = Record<string, Cell[]>;

export interface Rows {
  columns: string[];
  rows: Cell[][];
  truncated: boolean;
  seconds: number;
}

export interface Event {
  seq: number;
  at: string;
  severity: string;
  kind: string;
  data: unknown;
}

export interface Race {
  iteration: number;
  /// "Race 4", "Generation 4"; and a note if it is not a race.
  title: string;
  note: string;
  ended: boolean;
  rows_total: number;
  steps: number[];
  pairs: number[];
  instances: number[];
  seeds: number[];
  markers: string[];
  meanings: string[];
  /// Candidates alive after the step.
  alive: number[];
  p_value: (number | null)[];
  best: (number | null)[];
  mean_best: (number | null)[];
  /// Number of candidates with a rank, including those that are not in this answer.
  ranked: number[];
  candidates: number[];
  /// Rank among the elites; null if it is not an elite.
  elite_before: (number | null)[];
  elite_after: (number | null)[];
  /// The step that dropped the candidate; null: it is alive, or survived to the end.
  dropped_at: (number | null)[];
  reasons: (string | null)[];
  /// [step][i] for candidate i; null if the candidate was dropped earlier.
  scores: (number | null)[][];
  ranks: (number | null)[][];
}

export interface Iteration {
  iteration: number;
  planned: number;
  budget: number;
  configurations: number;
  elites: number;
  soft_restart: number;
  /// Shown instead of its number.
  round: string | null;
}

export interface Elite {
  iteration: number;
  rank: number;
  candidate: number;
  mean: number | null;
  n: number;
  experiments_used: number;
}

export interface DesignAnswer {
  design: { seed: number; reason: string | null; flavour: string; name: string } & Record<string, Cell>;
  iterations: Iteration[];
  elites: Elite[];
  /// The flavour is null for a program's configuration.
  machine: { candidate: number; text: string; flavour: string } | null;
  tests: { n: number; mean: number; low: number; high: number } | null;
  commands: { number: number; at: string; who: string; kind: string; step: number | null; budget: number | null }[];
}

/// Samples from the coordinator's memory: shares of the slots' time by cause, since the process
/// began.
export interface History {
  t_s: number[];
  evaluations_per_s: (number | null)[];
  [name: string]: any;
}

export interface View {
  name: string;
  text: string;
  columns: { name: string; text: string }[];
}
