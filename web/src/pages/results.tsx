// Results: which method is best, by how much, whether the difference is significant, and how it
// performed on real robots.

import { h } from "preact";
import { path_of } from "../api";
import { Choice, choice_of, command, Copy, Panel, place_of, Table } from "../components";
import { CsvTable, Figure } from "../figure";
import { duration, when, words } from "../format";
import { Get } from "../get";
import { PageProps } from "../page";
import { Cell, Columns, Row } from "../types";
import { version_of } from "./campaigns";
import { rows_of } from "./design";
import { Methods } from "./matrix";

export function Results({ params: { c }, query, campaign: { designs } }: PageProps) {
  const version = version_of(designs);
  const missions = designs.map((one) => one.mission);
  const ways = ["method", "source"];
  const several = new Set(designs.map((one) => one.method)).size > 1;
  const by = ways.includes(query.by) ? query.by : several ? "method" : "source";
  const mission = missions.includes(query.mission) ? query.mission : null;
  const figures: [string, string, boolean][] = [["box", `Winners' scores by ${by}`, true], ["ranks", `Mean ranks by ${by}`, true],
    ["scores", "How often each score occurred", true], ["training", "In the race, and tested", false],
    ["gap", "From one source to others", false], ["modules", "Modules of the winners", false]];
  const table = (title: string, path: string, show: (rows: Row[]) => JSX.Element) => <div class="grid"><Panel wide title={title}>
    <Get<Columns> path={`${c}/${path}`} version={version} render={(data) => show(rows_of(data))} /></Panel></div>;
  return <div>
    <h1>Results</h1>
    <div class="tools">
      <Choice label="Compare by" name="by" value={by} options={ways} />
      {choice_of("Mission", missions)}
      <Copy text={command("compare", `--by ${by}`)} />
    </div>
    {several && <Methods c={c} version={version} of={query.of} />}
    {table("Leaderboard", "leaderboard", leaderboard)}
    <div class="grid"><Panel wide title={`Tests by ${by}`}><Get<string> path={path_of(`${c}/comparison/pairs.csv`, { by, mission })} version={version}
      render={(text) => <CsvTable text={text} name={`tests by ${by}`} id="pairs" first="mission source method first second n_first p_holm p mean_difference a12 magnitude" />} /></Panel></div>
    <div class="columns">
      {figures.map(([kind, title, compares]) => <Panel title={title}><Figure kind={kind} options={{ by: compares ? by : null, mission }} version={version} name={title} /></Panel>)}
    </div>
    {table("Real runs", "real-runs", real_runs)}
  </div>;
}

function leaderboard(rows: Row[]) {
  return <Table name="b" caption="leaderboard" rows={rows} row_key={(one) => String(one.design)}
    empty="No design has a winner yet: a design has one when it has finished." columns={[
      { key: "mission", show: (one) => words(String(one.mission)) }, "rank", "design", "method", "repetition",
      { key: "candidate", label: "winner" }, { key: "test_mean", label: "mean of tests", title: "higher is better" },
      { key: "test_runs", label: "tests" }, { key: "race_mean", label: "mean in the race" }]} />;
}

function real_runs(rows: Row[]) {
  return <Table name="f" caption="real runs" rows={rows}
    empty={["No real runs. Film one and score it: ", <code>swarmsmith track score VIDEO --arena ARENA.toml --into STORE</code>]} columns={[
      { key: "id", label: "run" }, "name", { key: "mission", show: (one) => words(String(one.mission ?? "–")) }, "candidate",
      { key: "score", title: "higher is better" },
      { key: "verdict", show: ({ verdict, counts }) => counts ? verdict : <span class="warn">{verdict}, does not count</span> },
      { key: "reason", label: "why", value: ({ reason, overridden_by, reasons }) => [reason, overridden_by && `said by ${overridden_by}`, reasons_of(reasons)].filter(Boolean).join("; ") || null },
      { key: "duration_s", label: "length", show: (row) => duration(row.duration_s as number) },
      { key: "recorded", label: "filmed", show: (one) => when(String(one.recorded ?? "–")) },
      { key: "watch", show: ({ id, candidate }) => candidate !== null
        && <a href={place_of(String(id), { beside: `${id}-1,${id}-2`, speed: 1 })}>beside its simulations</a> }]} />;
}

/// The reasons from the scoring: a JSON list of texts, or of objects with a text, or a plain text.
function reasons_of(value: Cell | undefined): string {
  try {
    return (JSON.parse(String(value ?? "[]")) as (string | { text?: string; code?: string })[])
      .map((one) => typeof one === "string" ? one : one.text ?? one.code ?? "").join("; ");
  } catch { return String(value); }
}
