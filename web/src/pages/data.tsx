import { Component, h } from "preact";
import { ApiError, ask, path_of } from "../api";
import { Empty, Failure, Panel, save_as, Table } from "../components";
import { count, duration, shell_word, whole } from "../format";
import { Get } from "../get";
import { Page, PageProps } from "../page";
import { set_query } from "../route";
import { Cell, Rows, View } from "../types";

/// To begin with: the numbers of the other pages.
const kQueries: [string, string][] = [
  ["designs", "SELECT design, mission, method, repetition, state, used, budget, best_candidate, best_mean FROM v_designs"],
  ["winners", "SELECT * FROM v_leaderboard"],
  ["convergence", "SELECT * FROM v_convergence WHERE rank = 1"],
  ["modules", "SELECT * FROM v_module_frequency"],
  ["failures", "SELECT id, reason, host, at FROM v_failures LIMIT 100"],
];

class Data extends Component<PageProps, { sql: string; asked: string; error: ApiError | null }> {
  state = { sql: this.props.query.q ?? "", asked: this.props.query.q ?? "", error: null };

  componentWillReceiveProps(next: PageProps) {
    const q = next.query.q ?? "";
    if (q !== this.state.asked) this.setState({ sql: q, asked: q });
  }

  private run = (sql: string) => {
    this.setState({ sql, asked: sql, error: null });
    set_query({ q: sql, "q.page": null, "q.sort": null, "q.q": null }, true);
  };

  private csv = async () => {
    try {
      save_as("query.csv", "text/csv", (await ask(path_of(`${this.props.params.c}/query`, { sql: this.state.asked, format: "csv" }))).text);
    } catch (error) { this.setState({ error: error as ApiError }); }
  };

  private result({ columns, rows, truncated, seconds }: Rows) {
    return <div>
      <div class="tools"><span role="status">{count(rows.length, "row")}{truncated && <b class="warn">, cut at {whole(rows.length)}: add a WHERE or a LIMIT, or take the command line</b>}, {duration(seconds)}</span>
        <button class="quiet" onClick={this.csv}>CSV of all</button></div>
      <Table<Cell[]> name="q" caption="Result" rows={rows} row_key={(row) => String(rows.indexOf(row))} empty="No rows."
        columns={columns.map((key, i) => ({ key, label: key, value: (row) => row[i] }))} />
    </div>;
  }

  render() {
    const { params: { c }, live } = this.props;
    const { sql, asked, error } = this.state;
    const campaign = live.campaigns.find((one) => one.c === c);
    if (!campaign) return <Empty>There is no campaign {c} here. <a href="#/">All campaigns</a></Empty>;
    return <div>
      <h1>Data <span class="light">of {campaign.store}</span></h1>
      <div class="grid">
        <Panel title="Ask in SQL, read-only" command={`swarmsmith query ${shell_word(sql)} ${shell_word(campaign.store)}`}>
          <form onSubmit={(e) => { e.preventDefault(); this.run(sql); }}>
            <textarea rows={6} {...{ spellcheck: false }} aria-label="SQL" value={sql} placeholder="SELECT * FROM v_designs"
              onInput={(e) => this.setState({ sql: (e.target as HTMLTextAreaElement).value })}
              onKeyDown={(e) => { if (e.key === "Enter" && (e.ctrlKey || e.metaKey)) { e.preventDefault(); this.run(sql); } }} />
            <div class="tools"><button type="submit" class="main" disabled={!sql.trim()}>Ask</button><span class="faint small">or Ctrl+Enter; one statement, at most 10 s and 10{"\u2009"}000 rows; nothing can be written</span></div>
          </form>
          <p class="tools"><span class="faint">To begin with:</span> {kQueries.map(([name, text]) => <button class="quiet" onClick={() => this.run(text)}>{name}</button>)}</p>
        </Panel>
        <Panel title="Views, the public schema">
          <Get<{ views: View[] }> path={`${c}/views`} render={({ views }) => <div class="views">{views.map((view) => <details key={view.name}>
            <summary><code>{view.name}</code> <span class="faint small">{view.text}</span></summary>
            <dl class="pairs">{view.columns.map((column) => <div><dt><code>{column.name}</code></dt><dd>{column.text}</dd></div>)}</dl>
            <button class="quiet" onClick={() => this.run(`SELECT * FROM ${view.name} LIMIT 100`)}>first 100 rows</button>
          </details>)}</div>} />
        </Panel>
        <Panel wide title="Result">
          {error && <Failure error={error} />}
          {asked ? <Get<Rows> key={asked} path={path_of(`${c}/query`, { sql: asked })} render={(rows) => this.result(rows)} />
            : <Empty>Ask something, and the answer stands here.</Empty>}</Panel>
      </div>
    </div>;
  }
}

export const data: Page = {
  pattern: ":c/sql", title: () => "Data", view: Data,
  nav: { label: "Data", letter: "s", path: ({ c }) => [c, "sql"] },
  keys: [{ key: "Ctrl Enter", what: "ask" }],
};
