// Results: who is best, by how much, whether that is more than chance, and what became of it on real robots.

import { Component, h } from "preact";
import { Choice, Copy, Empty, Panel, Table } from "../components";
import { Figure } from "../figure";
import { duration, id_of, shell_word, when, words } from "../format";
import { Get } from "../get";
import { Page, PageProps } from "../page";
import { href } from "../route";
import { Cell, Columns } from "../types";

type Row = Record<string, Cell>;

/// Columns as rows; what is no column, such as v, is left out.
function rows_of(columns: Columns | Record<string, unknown>): Row[] {
  const names = Object.keys(columns).filter((name) => Array.isArray(columns[name]));
  if (names.length === 0) return [];
  return (columns[names[0]] as Cell[]).map((_, at) => Object.fromEntries(names.map((name) => [name, (columns[name] as Cell[])[at]])));
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
        {figures.map(([kind, title, compares]) => <Panel title={title}><Figure c={c} kind={kind} options={compares ? options : { mission: options.mission }}
          version={version} name={title} missing={(error) => <Empty>{error.message}</Empty>} /></Panel>)}
      </div>
      <div class="grid"><Panel wide title="Real runs"><Get<Columns> path={`${c}/real-runs`} version={version} render={(data) => this.real_runs(rows_of(data))} /></Panel></div>
    </div>;
  }

  private leaderboard(rows: Row[]) {
    const { c } = this.props.params;
    return <Table<Row> name="b" caption="leaderboard" rows={rows} row_key={(row) => String(row.design)} page_size={30}
      empty="No design has a winner yet: it has one when it has finished." columns={[
        { key: "mission", show: (row) => words(String(row.mission)) },
        { key: "rank", numeric: true },
        { key: "design", value: (row) => id_of("d", row.design), show: (row) => <a href={href([c, id_of("d", row.design)!])}>{id_of("d", row.design)}</a> },
        { key: "method" },
        { key: "repetition", numeric: true },
        { key: "candidate", label: "winner", value: (row) => id_of("c", row.candidate), show: (row) => row.candidate === null ? "–" : <a href={href([c, id_of("c", row.candidate)!])}>{id_of("c", row.candidate)}</a> },
        { key: "test_mean", label: "mean of tests", numeric: true, title: "higher is better" },
        { key: "test_runs", label: "tests", numeric: true },
        { key: "race_mean", label: "mean in the race", numeric: true },
      ]} />;
  }

  private real_runs(rows: Row[]) {
    const { c } = this.props.params;
    return <Table<Row> name="f" caption="real runs" rows={rows} row_key={(row) => String(row.id)} page_size={30}
      empty={<span>No real run. Film one and score it: <code>swarmsmith track score VIDEO --arena ARENA.toml --into STORE</code></span>} columns={[
        { key: "id", label: "run", value: (row) => id_of("r", row.id), show: (row) => <a href={href([c, "runs", id_of("r", row.id)!])}>{id_of("r", row.id)}</a> },
        { key: "name" },
        { key: "mission", show: (row) => words(String(row.mission ?? "–")) },
        { key: "candidate", value: (row) => id_of("c", row.candidate), show: (row) => row.candidate === null ? "–" : <a href={href([c, id_of("c", row.candidate)!])}>{id_of("c", row.candidate)}</a> },
        { key: "score", numeric: true, title: "higher is better" },
        { key: "verdict", show: (row) => <span class={row.counts ? "" : "warn"}>{row.verdict}{row.counts ? "" : ", does not count"}</span> },
        { key: "reason", label: "why", value: (row) => [row.reason, row.overridden_by && `said by ${row.overridden_by}`].filter(Boolean).join("; ") || null },
        { key: "duration_s", label: "length", numeric: true, show: (row) => duration(row.duration_s as number) },
        { key: "recorded", label: "filmed", show: (row) => <span title={String(row.recorded ?? "")}>{when(row.recorded as string)}</span> },
        { key: "watch", show: (row) => row.candidate === null ? null
          : <a href={href([c, "runs", id_of("r", row.id)!], { beside: [1, 2].map((seed) => `${id_of("r", row.id)}-${seed}`).join(","), speed: 1 })}>beside its simulations</a> },
      ]} />;
  }
}

export const results: Page = { pattern: ":c/results", title: () => "results", view: Results,
  nav: { label: "Results", letter: "e", path: ({ c }) => [c, "results"] } };
