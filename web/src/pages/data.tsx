import { Component, h } from "preact";
import { ApiError, ask, path_of } from "../api";
import { command, Empty, Failure, pairs, Panel, Quiet, save_as, Table, typed } from "../components";
import { count, duration, shell_word } from "../format";
import { Get } from "../get";
import { PageProps } from "../page";
import { set_query } from "../route";
import { Cell, Rows, View } from "../types";

/// The views to begin with: the numbers of the other pages.
const kViews = ["v_designs", "v_leaderboard", "v_convergence", "v_module_frequency", "v_failures"];

/// `sql` is the text in the field, `asked` is the last statement that was run.
interface State { sql: string; asked: string; error?: ApiError }

export class Data extends Component<PageProps, State> {
  state: State = { sql: this.props.query.q ?? "", asked: this.props.query.q ?? "" };

  componentWillReceiveProps({ query: { q = "" } }: PageProps) {
    if (q !== this.state.asked) this.setState({ sql: q, asked: q });
  }

  #run = (sql: string) => {
    this.setState({ sql, asked: sql, error: undefined });
    set_query({ q: sql, "q.page": null, "q.sort": null, "q.q": null }, true);
  };

  #first(view: string): void { this.#run(`SELECT * FROM ${view} LIMIT 100`); }

  #result({ columns, rows, truncated, seconds }: Rows) {
    const csv = () => ask(path_of(`${this.props.params.c}/query`, { sql: this.state.asked, format: "csv" }))
      .then((one) => save_as("query.csv", one.data as string), (error) => this.setState({ error }));
    return <div>
      <div class="tools"><span role="status">{count(rows.length, "row")}{truncated && <b class="warn">, cut after 10{"\u2009"}000 rows or 10 s: add a WHERE or a LIMIT, or use the command line</b>}, {duration(seconds)}</span>
        <Quiet act={csv}>CSV of all</Quiet></div>
      <Table<Cell[]> name="q" caption="Result" rows={rows} row_key={(row) => rows.indexOf(row)} empty="No rows."
        columns={columns.map((key, i) => ({ key, label: key, value: (row) => row[i] }))} />
    </div>;
  }

  render({ params: { c }, campaign }: PageProps, { sql, asked, error }: State) {
    const ask_now = (event: Event) => { event.preventDefault(); this.#run(sql); };
    return <div>
      <h1>Data <small>of {campaign.store}</small></h1>
      <div class="grid">
        <Panel title="Ask in SQL, read-only" command={command(`query ${shell_word(sql)}`)}>
          <form onSubmit={ask_now}>
            <textarea rows={6} {...{ spellcheck: false }} aria-label="SQL" value={sql} placeholder="SELECT * FROM v_designs"
              onInput={(event) => this.setState({ sql: typed(event) })}
              onKeyDown={(event) => { if (event.key === "Enter" && (event.ctrlKey || event.metaKey)) ask_now(event); }} />
            <div class="tools"><button type="submit" class="main" disabled={!sql.trim()}>Ask</button><small>or Ctrl+Enter; one statement, at most 10 s and 10{"\u2009"}000 rows; read-only</small></div>
          </form>
          <p class="tools"><span class="faint">Examples:</span> {kViews.map((name) => <Quiet act={() => this.#first(name)}>{name.slice(2).replace("_", " ")}</Quiet>)}</p>
        </Panel>
        <Panel title="Views, the public schema">
          <Get<{ views: View[] }> path={`${c}/views`} render={(one) => <div class="views">{one.views.map(({ name, text, columns }) => <details key={name}>
            <summary><code>{name}</code> <small>{text}</small></summary>
            {pairs("pairs", columns.map((column) => [<code>{column.name}</code>, column.text]))}
            <Quiet act={() => this.#first(name)}>first 100 rows</Quiet>
          </details>)}</div>} />
        </Panel>
        <Panel wide title="Result">
          {error && <Failure error={error} />}
          {asked ? <Get<Rows> key={asked} path={path_of(`${c}/query`, { sql: asked })} render={(rows) => this.#result(rows)} />
            : <Empty>No query yet.</Empty>}</Panel>
      </div>
    </div>;
  }
}
