import { Component, h } from "preact";
import { ApiError, token } from "./api";
import { csv, number, percent, when, whole } from "./format";
import { current_route, href, set_query } from "./route";

type Child = JSX.Element | string | number | null | undefined | false;
type Children = Child | Children[];

// --- sentences --------------------------------------------------------------------------------------

export function Failure({ error, again }: { error: ApiError; again?: () => void }) {
  return <div class="failure" role="alert">
    <strong>{error.where ? `${error.where}: ` : ""}</strong>{error.message}
    {error.status === 401 && <span> Open the address that the coordinator printed, with its token.</span>}
    {again && <button onClick={again}>Try again</button>}
  </div>;
}

/// Says so only after a moment: most answers are faster than a person reads.
export class Waiting extends Component<{}, { long: boolean }> {
  private timer = 0;
  state = { long: false };
  componentDidMount() { this.timer = window.setTimeout(() => this.setState({ long: true }), 300); }
  componentWillUnmount() { clearTimeout(this.timer); }
  render() { return <p class="waiting" aria-busy="true">{this.state.long ? "Asking the server …" : "\u00a0"}</p>; }
}

/// Why there is nothing here, and what to do.
export function Empty({ children }: { children?: Children }) {
  return <p class="empty">{children as JSX.Element}</p>;
}

/// Tells people who hear the page; the region stands in index.html, where no renewal empties it.
export function announce(text: string): void {
  const region = document.getElementById("announcer");
  if (region) region.textContent = text;
}

// --- small parts ------------------------------------------------------------------------------------

interface PanelProps {
  title: string;
  wide?: boolean;
  /// The command line, and the statement for the data page, that give the same.
  command?: string;
  sql?: string;
  tools?: Children;
  children?: Children;
}

export function Panel({ title, children, wide, tools, command, sql }: PanelProps) {
  return <section class={wide ? "panel wide" : "panel"} aria-label={title}>
    <div class="panel-head"><h2>{title}</h2><div class="tools">{tools as JSX.Element}
      {command && <Copy what="Copy as command" text={command} />}
      {sql && <a class="small" href={href([current_route().path[0], "sql"], { q: sql })} aria-label={`SQL: ${title}`}>SQL</a>}</div></div>
    {children as JSX.Element}
  </section>;
}

/// Leads to a candidate or a design of the campaign that is looked at: To("c", 812).
export function To(letter: string, number: number | string) {
  return <a href={href([current_route().path[0], letter + number])}>{letter}{number}</a>;
}

/// A number with its name above.
export function Fact({ name, children, title }: { name: string; children?: Children; title?: string }) {
  return <div class="fact" title={title}><dt>{name}</dt><dd>{children as JSX.Element}</dd></div>;
}

export function Bar({ value, of, name }: { value: number; of: number; name: string }) {
  const part = of > 0 ? Math.min(1, value / of) : 0;
  return <div class="bar" role="progressbar" aria-label={name} aria-valuemin={0} aria-valuemax={100}
    aria-valuenow={Math.round(100 * part)} aria-valuetext={`${whole(value)} of ${whole(of)}, ${percent(part)}`}>
    <div class="bar-done" style={{ width: `${100 * part}%` }} /></div>;
}

/// A list of one choice that the address keeps: pairs of the text and the word in the address.
export function Choice({ label, name, value, options }: { label: string; name: string; value: string; options: [string, string][] }) {
  return <label>{label} <select onChange={(event) => set_query({ [name]: (event.target as HTMLSelectElement).value })}>
    {options.map(([text, word]) => <option value={word} selected={word === value}>{text}</option>)}</select></label>;
}

/// The state of a design, a campaign or a worker: always a word, the mark beside it only helps.
export function StateWord({ state, paused }: { state: string; paused?: boolean }) {
  const word = paused ? "paused" : state;
  return <span class={`state state-${word.replace(/\W/g, "-")}`}>{word}</span>;
}

export class Copy extends Component<{ text: string; what: string }, { done: string }> {
  state = { done: "" };
  copy = async () => {
    const { text, what } = this.props;
    // Browsers refuse it where the address is neither local nor https: by hand, then.
    try { await navigator.clipboard.writeText(text); } catch { prompt(what, text); return; }
    this.setState({ done: "Copied" });
    announce(`Copied: ${what}`);
    setTimeout(() => this.setState({ done: "" }), 1500);
  };
  render() {
    return <button class="quiet" onClick={this.copy} title={this.props.text}>{this.state.done || this.props.what}</button>;
  }
}

export function save_as(name: string, type: string, text: string): void {
  const address = URL.createObjectURL(new Blob([text], { type }));
  const link = document.createElement("a");
  link.href = address;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 1000);
}

// --- a question before something is done ------------------------------------------------------------

interface ConfirmProps {
  label: string;
  title: string;
  /// What will happen, and how to undo it.
  children?: Children;
  /// Does it; the sentence that it answers is shown.
  act: () => Promise<string>;
  danger?: boolean;
}

/// A button that asks before it acts. Without the token it says how to get it.
export class Confirm extends Component<ConfirmProps, { open: boolean; busy: boolean; said: string; failed: boolean }> {
  state = { open: false, busy: false, said: "", failed: false };
  private dialog: HTMLDialogElement | null = null;
  open = () => { this.setState({ open: true, said: "", failed: false }, () => this.dialog?.showModal()); };
  close = () => { this.dialog?.close(); this.setState({ open: false }); };
  act = async () => {
    this.setState({ busy: true });
    try {
      const said = await this.props.act();
      this.setState({ busy: false, said, failed: false });
      announce(said);
    } catch (error) {
      this.setState({ busy: false, said: (error as Error).message, failed: true });
    }
  };
  render() {
    const { label, title, children, danger } = this.props;
    const { open, busy, said, failed } = this.state;
    return <span class="confirm">
      <button class={danger ? "danger" : ""} onClick={this.open}>{label}</button>
      {open && <dialog ref={(e: any) => (this.dialog = e)} aria-label={title}
        {...{ onClose: () => this.setState({ open: false }) }}>
        <h2>{title}</h2>
        {!said && <div>{children as JSX.Element}</div>}
        {!said && !token() && <p class="warn">This needs the coordinator's token. Open the address with <code>#t=...</code> that it printed on its terminal; it is also in the file <code>.token</code> beside the store.</p>}
        {said && <p class={failed ? "failure" : "done"} role="status">{said}</p>}
        <div class="tools">
          <button onClick={this.close}>{said ? "Close" : "Leave it"}</button>
          {!said && <button class={danger ? "danger" : "main"} disabled={busy || !token()} onClick={this.act}>{busy ? "Doing it …" : label}</button>}
        </div>
      </dialog>}
    </span>;
  }
}

// --- tables -----------------------------------------------------------------------------------------

type Value = string | number | null | undefined;

export interface Column<Row> {
  key: string;
  /// Else the key, in words.
  label?: string;
  /// What it is sorted and filtered by, and what CSV has; else the row's field of the key's name.
  value?: (row: Row) => Value;
  /// What is shown; else the value as `usual` shows it.
  show?: (row: Row) => Children;
  /// Else when all its values are numbers.
  numeric?: boolean;
  title?: string;
}

interface TableProps<Row> {
  /// Prefix of its state in the address, such as "w": w.sort=-busy, w.q=node, w.page=2. Tables of one
  /// view have different ones.
  name: string;
  caption: string;
  columns: Column<Row>[];
  rows: Row[];
  /// Sorted so unless the address says otherwise: "-busy" puts the largest first.
  sort?: string;
  /// A stable name of the row, so that focus stays with it; else the value of its first column.
  row_key?: (row: Row) => string;
  row_class?: (row: Row) => string;
  empty?: Children;
  page_size?: number;
}

/// A value as its column's name says: things lead to their pages, times are those of the reader.
function usual(column: string, value: Value): Children {
  if (value === null || value === undefined) return "–";
  if (/^(best_?)?(candidate)?$|^parent$/.test(column) && typeof value === "number") return To("c", value);
  if (column === "design" && typeof value === "number") return To("d", value);
  if (column === "id" && /^[er]\d/.test(String(value))) return <a href={href([current_route().path[0], "runs", String(value)])}>{value}</a>;
  if (column === "at") return <time dateTime={String(value)} title={`${value} UTC`}>{when(String(value))}</time>;
  return typeof value === "number" && column !== "seed" ? number(value) : value;
}

function value_of<Row>({ key, value }: Column<Row>, row: Row): Value {
  return value ? value(row) : (row as any)[key];
}

/// A table that sorts, filters and pages.
export class Table<Row> extends Component<TableProps<Row>, {}> {
  private sorted(rows: Row[], sort: string): Row[] {
    const down = sort.startsWith("-");
    const column = this.props.columns.find((c) => c.key === sort.replace(/^-/, ""));
    if (!column) return rows;
    return rows.map((row) => ({ row, value: value_of(column, row) })).sort((a, b) => {
      const [x, y] = [a.value, b.value];
      // What is not known comes last, whichever way.
      if (x === null || x === undefined) return y === null || y === undefined ? 0 : 1;
      if (y === null || y === undefined) return -1;
      const order = typeof x === "number" && typeof y === "number" ? x - y
        : String(x).localeCompare(String(y), "en", { numeric: true });
      return down ? -order : order;
    }).map((entry) => entry.row);
  }

  render() {
    const { name, caption, columns, rows, row_key, row_class, empty, sort: first_sort, page_size = 50 } = this.props;
    if (rows.length === 0) return <Empty>{empty ?? "Nothing here yet."}</Empty>;
    const { query } = current_route();
    const sort = query[name + ".sort"] ?? first_sort ?? "";
    const filter = (query[name + ".q"] ?? "").toLowerCase();
    const matching = filter === "" ? rows
      : rows.filter((row) => columns.some((c) => String(value_of(c, row) ?? "").toLowerCase().includes(filter)));
    const pages = Math.max(1, Math.ceil(matching.length / page_size));
    const page = Math.min(pages, Math.max(1, Number(query[name + ".page"] ?? 1) || 1));
    const shown = this.sorted(matching, sort).slice((page - 1) * page_size, page * page_size);
    const numeric = new Set(columns.filter((column) => {
      const kinds = new Set(rows.slice(0, 50).map((row) => typeof (value_of(column, row) ?? undefined)));
      return column.numeric ?? (kinds.delete("undefined"), kinds.size === 1 && kinds.has("number"));
    }).map((column) => column.key));
    const turn = (to: number) => set_query({ [name + ".page"]: to > 1 ? to : null });
    return <div class="table">
      {(rows.length > 8 || filter) && <div class="tools">
        <input type="search" placeholder="filter" aria-label={`filter: ${caption}`} value={query[name + ".q"] ?? ""}
          onInput={(e) => set_query({ [name + ".q"]: (e.target as HTMLInputElement).value, [name + ".page"]: null })} />
        <span class="faint" role="status">{filter ? `${whole(matching.length)} of ${whole(rows.length)}` : `${whole(rows.length)} rows`}</span>
        <button class="quiet" aria-label={`CSV: ${caption}`} onClick={() =>
          save_as(caption.replace(/\W+/g, "-") + ".csv", "text/csv",
            csv([columns.map((c) => c.key), ...this.sorted(matching, sort).map((row) => columns.map((c) => value_of(c, row)))]))}>CSV</button>
      </div>}
      <div class="scroll" tabIndex={0} role="region" aria-label={caption}>
        <table>
          <caption class="unseen">{caption}</caption>
          <thead><tr>{columns.map((column) => {
            const now = sort === column.key ? "ascending" : sort === "-" + column.key ? "descending" : "none";
            // Numbers are most wanted with the largest first.
            const next = now === "none" ? (numeric.has(column.key) ? "-" : "") + column.key : now === "ascending" ? "-" + column.key : column.key;
            return <th scope="col" class={numeric.has(column.key) ? "n" : ""} aria-sort={now} title={column.title}>
              <button onClick={() => set_query({ [name + ".sort"]: next, [name + ".page"]: null })}>
                {column.label ?? column.key.replace(/_/g, " ")}<span aria-hidden="true" class="arrow">{now === "ascending" ? "▲" : now === "descending" ? "▼" : ""}</span></button></th>;
          })}</tr></thead>
          <tbody>{shown.map((row) => <tr key={row_key ? row_key(row) : String(value_of(columns[0], row))} class={row_class?.(row) ?? ""}>{columns.map((column) => {
            const shown = column.show ? column.show(row) : usual(column.key, value_of(column, row));
            return <td class={numeric.has(column.key) ? "n" : ""}>{shown as JSX.Element}</td>;
          })}</tr>)}</tbody>
        </table>
      </div>
      {matching.length === 0 && <p class="empty">No row has “{filter}”.</p>}
      {pages > 1 && <div class="tools pages">
        <button disabled={page === 1} onClick={() => turn(page - 1)} aria-label={`previous page: ${caption}`}>‹</button>
        <span>page {whole(page)} of {whole(pages)}</span>
        <button disabled={page === pages} onClick={() => turn(page + 1)} aria-label={`next page: ${caption}`}>›</button>
      </div>}
    </div>;
  }
}
