// Results: who is best, by how much, whether that is more than chance, and what became of it on real robots.

import { Component, h } from "preact";
import { ApiError } from "../api";
import { Copy, Empty, Panel, Table } from "../components";
import { Figure } from "../figure";
import { duration, shell_word, when, words } from "../format";
import { Get } from "../get";
import { Page, PageProps } from "../page";
import { href, set_query } from "../route";
import { Cell, Columns } from "../types";

type Row = Record<string, Cell>;

/// Columns as rows; what is no column, such as v, is left out.
function rows_of(columns: Columns | Record<string, unknown>): Row[] {
  const names = Object.keys(columns).filter((name) => Array.isArray(columns[name]));
  if (names.length === 0) return [];
  return (columns[names[0]] as Cell[]).map((_, at) => Object.fromEntries(names.map((name) => [name, (columns[name] as Cell[])[at]])));
}

/// A letter's id from a number or a text that has it already.
function id_of(letter: string, value: Cell): string | null {
  return value === null || value === undefined ? null : typeof value === "number" ? letter + value : value;
}

class Results extends Component<PageProps, {}> {
  render() {
    const { params: { c }, query, live } = this.props;
    const campaign = live.campaigns.find((one) => one.c === c);
    const designs = campaign?.designs ?? [];
    const version = designs.map((one) => one.version).join(" ");
    const missions = [...new Set(designs.map((one) => one.mission))];
    const by = query.by === "method" || query.by === "source" ? query.by : new Set(designs.map((one) => one.method)).size > 1 ? "method" : "source";
    const options = { by, mission: missions.includes(query.mission) ? query.mission : null };
    const nothing = (error: ApiError) => <Empty>{error.message}</Empty>;
    return <div>
      <h1>Results</h1>
      <div class="tools">
        <label>Compare by <select onChange={(event) => set_query({ by: (event.target as HTMLSelectElement).value })}>
          {["method", "source"].map((word) => <option value={word} selected={word === by}>{word}</option>)}</select></label>
        {missions.length > 1 && <label>Mission <select onChange={(event) => set_query({ mission: (event.target as HTMLSelectElement).value })}>
          <option value="" selected={!options.mission}>all</option>
          {missions.map((mission) => <option value={mission} selected={mission === options.mission}>{words(mission)}</option>)}</select></label>}
        <Copy text={`swarmsmith compare ${shell_word(campaign?.store ?? "STORE")} --by ${by}`} what="Copy as command" />
      </div>
      <div class="grid"><Panel wide title="Leaderboard"><Get<Columns> path={`${c}/leaderboard`} version={version} render={(data) => this.leaderboard(rows_of(data))} /></Panel></div>
      <div class="columns">
        <Panel title={`Winners' scores by ${by}`}><Figure c={c} kind="box" options={options} version={version} name={`winners' scores by ${by}`} missing={nothing} /></Panel>
        <Panel title={`Mean ranks by ${by}`}><Figure c={c} kind="ranks" options={options} version={version} name={`mean ranks by ${by}`} missing={nothing} /></Panel>
        <Panel title="How often each score occurred"><Figure c={c} kind="scores" options={options} version={version} name="how often each score occurred" missing={nothing} /></Panel>
        <Panel title="In the race, and tested"><Figure c={c} kind="training" options={{ mission: options.mission }} version={version} name="race means beside test means" missing={nothing} /></Panel>
        <Panel title="From one source to others"><Figure c={c} kind="gap" options={{ mission: options.mission }} version={version} name="what winners lose from their simulator to other sources" missing={nothing} /></Panel>
        <Panel title="Modules of the winners"><Figure c={c} kind="modules" options={{ mission: options.mission }} version={version} name="modules of the winners" missing={nothing} /></Panel>
      </div>
      <div class="grid"><Panel wide title="Real runs"><Get<Columns> path={`${c}/real-runs`} version={version} render={(data) => this.real_runs(rows_of(data))} /></Panel></div>
    </div>;
  }

  private leaderboard(rows: Row[]) {
    const { c } = this.props.params;
    return <Table<Row> name="b" caption="leaderboard" rows={rows} row_key={(row) => String(row.design)} page_size={30}
      empty="No design has a winner yet: it has one when it has finished." columns={[
        { key: "mission", label: "mission", value: (row) => row.mission, show: (row) => words(String(row.mission)) },
        { key: "rank", label: "rank", numeric: true, value: (row) => row.rank },
        { key: "design", label: "design", value: (row) => id_of("d", row.design), show: (row) => <a href={href([c, id_of("d", row.design)!])}>{id_of("d", row.design)}</a> },
        { key: "method", label: "method", value: (row) => row.method },
        { key: "repetition", label: "repetition", numeric: true, value: (row) => row.repetition },
        { key: "candidate", label: "winner", value: (row) => id_of("c", row.candidate), show: (row) => row.candidate === null ? "–" : <a href={href([c, id_of("c", row.candidate)!])}>{id_of("c", row.candidate)}</a> },
        { key: "test_mean", label: "mean of tests", numeric: true, value: (row) => row.test_mean, title: "higher is better" },
        { key: "test_runs", label: "tests", numeric: true, value: (row) => row.test_runs },
        { key: "race_mean", label: "mean in the race", numeric: true, value: (row) => row.race_mean },
      ]} />;
  }

  private real_runs(rows: Row[]) {
    const { c } = this.props.params;
    return <Table<Row> name="f" caption="real runs" rows={rows} row_key={(row) => String(row.id)} page_size={30}
      empty={<span>No real run. Film one and score it: <code>swarmsmith track score VIDEO --arena ARENA.toml --into STORE</code></span>} columns={[
        { key: "id", label: "run", value: (row) => id_of("r", row.id), show: (row) => <a href={href([c, "runs", id_of("r", row.id)!])}>{id_of("r", row.id)}</a> },
        { key: "name", label: "name", value: (row) => row.name },
        { key: "mission", label: "mission", value: (row) => row.mission, show: (row) => words(String(row.mission ?? "–")) },
        { key: "candidate", label: "candidate", value: (row) => id_of("c", row.candidate), show: (row) => row.candidate === null ? "–" : <a href={href([c, id_of("c", row.candidate)!])}>{id_of("c", row.candidate)}</a> },
        { key: "score", label: "score", numeric: true, value: (row) => row.score, title: "higher is better" },
        { key: "verdict", label: "verdict", value: (row) => row.verdict, show: (row) => <span class={row.counts ? "" : "warn"}>{row.verdict}{row.counts ? "" : ", does not count"}</span> },
        { key: "reason", label: "why", value: (row) => [row.reason, row.overridden_by && `said by ${row.overridden_by}`].filter(Boolean).join("; ") || null },
        { key: "duration_s", label: "length", numeric: true, value: (row) => row.duration_s, show: (row) => duration(row.duration_s as number) },
        { key: "recorded", label: "filmed", value: (row) => row.recorded, show: (row) => <span title={String(row.recorded ?? "")}>{when(row.recorded as string)}</span> },
        { key: "watch", label: "watch", value: () => "", show: (row) => row.candidate === null ? null
          : <a href={href([c, "runs", id_of("r", row.id)!], { beside: `${id_of("c", row.candidate)}-1`, speed: 1 })}>beside its simulation</a> },
      ]} />;
  }
}

export const results: Page = { pattern: ":c/results", title: () => "results", view: Results,
  nav: { label: "Results", letter: "e", path: ({ c }) => [c, "results"] } };
