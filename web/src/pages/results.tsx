// Results: who is best, by how much, whether that is more than chance, and what became of it on real robots.

import { Component, h } from "preact";
import { ApiError, path_of } from "../api";
import { Choice, Copy, Empty, Panel, Table } from "../components";
import { CsvTable, Figure } from "../figure";
import { duration, shell_word, when, words } from "../format";
import { Get } from "../get";
import { Page, PageProps } from "../page";
import { href } from "../route";
import { Cell, Columns } from "../types";
import { rows_of } from "./design";

type Row = Record<string, Cell>;

function nothing(error: ApiError) { return <Empty>{error.message}</Empty>; }

class Results extends Component<PageProps, {}> {
  render() {
    const { params: { c }, query, live } = this.props;
    const campaign = live.campaigns.find((one) => one.c === c);
    const designs = campaign?.designs ?? [];
    const version = designs.map((one) => one.version).join(" ");
    const missions = [...new Set(designs.map((one) => one.mission))];
    const by = query.by === "method" || query.by === "source" ? query.by : new Set(designs.map((one) => one.method)).size > 1 ? "method" : "source";
    const options = { by, mission: missions.includes(query.mission) ? query.mission : null };
    const figures: [string, string, boolean][] = [["box", `Winners' scores by ${by}`, true], ["ranks", `Mean ranks by ${by}`, true],
      ["scores", "How often each score occurred", true], ["training", "In the race, and tested", false],
      ["gap", "From one source to others", false], ["modules", "Modules of the winners", false]];
    return <div>
      <h1>Results</h1>
      <div class="tools">
        <Choice label="Compare by" name="by" value={by} options={[["method", "method"], ["source", "source"]]} />
        {missions.length > 1 && <Choice label="Mission" name="mission" value={options.mission ?? ""}
          options={[["all", ""], ...missions.map((mission): [string, string] => [words(mission), mission])]} />}
        <Copy text={`swarmsmith compare ${shell_word(campaign?.store ?? "STORE")} --by ${by}`} what="Copy as command" />
      </div>
      <div class="grid"><Panel wide title="Leaderboard"><Get<Columns> path={`${c}/leaderboard`} version={version} render={(data) => this.leaderboard(rows_of(data))} /></Panel></div>
      <div class="columns">
        <Panel title={`Tests by ${by}`}><Get<string> path={path_of(`${c}/comparison/pairs.csv`, options)} version={version} missing={nothing}
          render={(text) => <CsvTable text={text} name={`tests by ${by}`} id="pairs" />} /></Panel>
        {figures.map(([kind, title, compares]) => <Panel title={title}><Figure c={c} kind={kind} options={compares ? options : { mission: options.mission }}
          version={version} name={title} missing={nothing} /></Panel>)}
      </div>
      <div class="grid"><Panel wide title="Real runs"><Get<Columns> path={`${c}/real-runs`} version={version} render={(data) => this.real_runs(rows_of(data))} /></Panel></div>
    </div>;
  }

  private leaderboard(rows: Row[]) {
    return <Table<Row> name="b" caption="leaderboard" rows={rows} row_key={(row) => String(row.design)} page_size={30}
      empty="No design has a winner yet: it has one when it has finished." columns={[
        { key: "mission", show: (row) => words(String(row.mission)) }, { key: "rank" }, { key: "design" }, { key: "method" }, { key: "repetition" },
        { key: "candidate", label: "winner" }, { key: "test_mean", label: "mean of tests", title: "higher is better" },
        { key: "test_runs", label: "tests" }, { key: "race_mean", label: "mean in the race" },
      ]} />;
  }

  private real_runs(rows: Row[]) {
    const { c } = this.props.params;
    return <Table<Row> name="f" caption="real runs" rows={rows} page_size={30}
      empty={<span>No real run. Film one and score it: <code>swarmsmith track score VIDEO --arena ARENA.toml --into STORE</code></span>} columns={[
        { key: "id", label: "run" }, { key: "name" }, { key: "mission", show: (row) => words(String(row.mission ?? "–")) }, { key: "candidate" },
        { key: "score", title: "higher is better" },
        { key: "verdict", show: (row) => <span class={row.counts ? "" : "warn"}>{row.verdict}{row.counts ? "" : ", does not count"}</span> },
        { key: "reason", label: "why", value: (row) => [row.reason, row.overridden_by && `said by ${row.overridden_by}`, reasons_of(row.reasons)].filter(Boolean).join("; ") || null },
        { key: "duration_s", label: "length", show: (row) => duration(row.duration_s as number) },
        { key: "recorded", label: "filmed", show: (row) => when(row.recorded as string) },
        { key: "watch", show: (row) => row.candidate === null ? null
          : <a href={href([c, "runs", String(row.id)], { beside: `${row.id}-1,${row.id}-2`, speed: 1 })}>beside its simulations</a> },
      ]} />;
  }
}

/// What the scoring said: a JSON list of texts or of objects with one, or what is already a text.
function reasons_of(value: Cell | undefined): string {
  try {
    return (JSON.parse(String(value ?? "[]")) as (string | { text?: string; code?: string })[])
      .map((one) => typeof one === "string" ? one : one.text ?? one.code ?? "").join("; ");
  } catch { return String(value); }
}

export const results: Page = { pattern: ":c/results", title: () => "results", view: Results,
  nav: { label: "Results", letter: "e", path: ({ c }) => [c, "results"] } };
