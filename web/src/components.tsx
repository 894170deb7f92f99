import { Component, h } from "preact";
import { ApiError, feed, is_snapshot, Pending, token } from "./api";
import { clamp, count, csv, in_order, is_known, number, percent, shell_word, when, whole, words } from "./format";
import { current_route, href, Query, set_query } from "./route";
import { Campaign } from "./types";

type Child = JSX.Element | string | number | boolean | null | undefined;
export type Children = Child | Children[];

/// The current value of a field or a list.
export function typed(event: Event): string { return (event.target as HTMLInputElement).value; }

/// Whether a key press belongs to the browser, or to the field or list that has the focus.
export function is_typing({ target, ctrlKey, metaKey, altKey }: KeyboardEvent): boolean {
  const { tagName, type } = target as HTMLInputElement;
  return ctrlKey || metaKey || altKey || /^(INPUT|TEXTAREA|SELECT)$/.test(tagName) && type !== "range";
}

// --- sentences --------------------------------------------------------------------------------------

export function Failure({ error, again }: { error: ApiError; again?: () => void }) {
  return <div class="failure" role="alert">
    <strong>{error.where && error.where + ": "}</strong>{error.message}
    {error.status === 401 && " Open the address that the coordinator printed, with its token."}
    {again && <button onClick={again}>Try again</button>}
  </div>;
}

/// style.css delays showing it for a moment.
export function Waiting({ pending }: { pending?: Pending }) {
  return <p class="waiting" aria-busy="true">Asking the server{pending && `, for ${Math.round(pending.seconds)} s`} …</p>;
}

/// An explanation why there is nothing here, and advice.
export function Empty({ children }: { children?: Children }) {
  return <p class="empty">{children as JSX.Element}</p>;
}

/// Announces a text to screen readers. The element is in index.html, where re-rendering does not
/// empty it.
export function announce(text: string): void {
  document.getElementById("announcer")!.textContent = text;
}

// --- the current campaign ---------------------------------------------------------------------------

/// The campaign in the address, else the first one; undefined if there is none.
export function current_campaign(): Campaign | undefined {
  const campaigns = feed.live?.campaigns ?? [];
  return campaigns.find((one) => one.c === current_route().path[0]) ?? campaigns[0];
}

/// The store of a campaign as an argument for a command line.
export function store_word(campaign = current_campaign()): string { return shell_word(campaign?.store ?? "STORE"); }

/// A command line for a campaign's store: command("figure race", "--design d3").
export function command(what: string, options = "", campaign?: Campaign): string {
  return `swarmsmith ${what} ${store_word(campaign)} ${options}`.trim();
}

/// The address of the page for an id of the current campaign: "c812", "d3", "e81200007", "r7".
export function place_of(id: string, query?: Query): string {
  return href([current_route().path[0], ...(/^[er]/.test(id) ? ["runs"] : []), id], query);
}

/// A link to that page.
export function link(id: string, text: Children = id) {
  return <a href={place_of(id)}>{text as JSX.Element}</a>;
}

// --- small parts ------------------------------------------------------------------------------------

interface PanelProps {
  title: string;
  wide?: boolean;
  /// The command line, and the SQL statement for the data page, that give the same data.
  command?: string;
  sql?: string;
  tools?: Children;
  children?: Children;
}

export function Panel({ title, children, wide, tools, command, sql }: PanelProps) {
  return <section class={wide ? "panel wide" : "panel"} aria-label={title}>
    <div class="panel-head"><h2>{title}</h2><div class="tools">{tools as JSX.Element}
      {command && <Copy text={command} />}
      {sql && !is_snapshot && <a class="small" href={href([current_route().path[0], "sql"], { q: sql })} aria-label={`SQL: ${title}`}>SQL</a>}</div></div>
    {children as JSX.Element}
  </section>;
}

/// A small button; `label` names it if its text alone is not clear.
export function Quiet({ act, label, children, title = label, ...rest }: { act: () => void; label?: string; children?: Children } & JSX.HTMLAttributes) {
  return <button class="quiet" aria-label={label} title={title} onClick={act} {...rest}>{children as JSX.Element}</button>;
}

/// Experiments of a design or campaign; `left`: the number that its races may still use.
export interface Spent { used: number; budget: number; left: number }

/// The progress from 0 to 1. A finished design counts as 1, even if it did not use its whole
/// budget.
export function part_of({ budget, left }: Spent): number { return budget > 0 ? clamp(1 - left / budget, 0, 1) : 0; }

/// "1 200 of 3 000"; "1 200" if the budget is a time.
export function spent_of({ used, budget }: Spent): string { return whole(used) + (budget > 0 ? ` of ${whole(budget)}` : ""); }

/// A list of names and values, with optional tooltips. False entries are left out.
export function pairs(kind: string, list: ([name: Children, value: Children, title?: string] | false | null | "")[]) {
  return <dl class={kind}>{list.map((one) => one && <div title={one[2]}><dt>{one[0] as JSX.Element}</dt><dd>{one[1] as JSX.Element}</dd></div>)}</dl>;
}

export function Bar({ of, name }: { of: Spent; name: string }) {
  const part = part_of(of);
  return <div class="bar" role="progressbar" aria-label={name} aria-valuemin={0} aria-valuemax={100}
    aria-valuenow={Math.round(100 * part)} aria-valuetext={`${spent_of(of)}, ${percent(part)}`}>
    <div style={{ width: `${100 * part}%` }} /></div>;
}

/// "1 200 of 3 000, 40 %" for a budget.
export function used_of(of: Spent): Children {
  return [whole(of.used), of.budget > 0 && [" ", <small>of {whole(of.budget)}, {percent(part_of(of))}</small>]];
}

interface ChoiceProps {
  label: string;
  /// Name of the parameter in the address; by default the label.
  name?: string;
  /// By default the value in the address.
  value?: string;
  /// Values in the address, "" for all; or pairs of text and value.
  options: (string | [text: string, word: string])[];
}

/// A list with one selected value, which is kept in the address.
export function Choice({ label, name = label.toLowerCase(), value = current_route().query[name] ?? "", options }: ChoiceProps) {
  return <label>{label} <select onChange={(event) => set_query({ [name]: typed(event) })}>
    {options.map((one) => typeof one === "string" ? [words(one) || "all", one] : one).map(([text, word]) =>
      <option value={word} selected={word === value}>{text}</option>)}</select></label>;
}

/// A choice of one value or all; nothing if there is only one value.
export function choice_of(label: string, values: string[]) {
  const all = in_order(values);
  return all.length > 1 && <Choice label={label} options={["", ...all]} />;
}

interface SliderProps { id?: string; label?: string; text?: string; min?: number; max: number; value: number; to: (value: number) => void }

/// `text` is the value as spoken by screen readers.
export function Slider({ id, label, text, min = 0, max, value, to }: SliderProps) {
  return <input type="range" id={id} aria-label={label} aria-valuetext={text} min={min} max={max} value={String(value)} disabled={max <= min}
    onInput={(event) => to(Number(typed(event)))} />;
}

/// The state of a design, a campaign or a worker. It is always written as a word; the symbol beside
/// it is only an addition.
export function state_word({ state, paused = false }: { state: string; paused?: boolean }) {
  const word = paused ? "paused" : state;
  return <span class={`state state-${word.replace(/\W/g, "-")}`}>{word}</span>;
}

export class Copy extends Component<{ text: string; what?: string }, { done: boolean }> {
  #copy = async () => {
    const { text, what = "Copy as command" } = this.props;
    // Browsers refuse this if the address is neither local nor https; then the user must copy the
    // text by hand.
    try { await navigator.clipboard.writeText(text); } catch { prompt(what, text); return; }
    this.setState({ done: true });
    announce(`Copied: ${what}`);
    setTimeout(() => this.setState({ done: false }), 1500);
  };
  render({ text, what = "Copy as command" }: { text: string; what?: string }, { done }: { done: boolean }) {
    return <Quiet act={this.#copy} title={text}>{done ? "Copied" : what}</Quiet>;
  }
}

/// Saves a table if the name ends in ".csv", else a picture.
export function save_as(name: string, text: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([text], { type: name.endsWith("csv") ? "text/csv" : "image/svg+xml" }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

// --- confirmation of commands -----------------------------------------------------------------------

interface ConfirmProps {
  label: string;
  title: string;
  /// A description of the effect, and how to undo it.
  children?: any;
  /// Carries out the command; the sentence that it returns is shown.
  act: () => Promise<string>;
  danger?: boolean;
  /// Whether the button is there; true by default. An open dialog stays until it is closed, although
  /// its own command may take the button away.
  is_offered?: boolean;
}

/// `said` is the sentence that says what was done, or the reason why it was not.
interface ConfirmState { is_open?: boolean; is_busy?: boolean; said?: string; has_failed?: boolean }

/// A button that asks for confirmation. Without the token it explains how to get the token.
export class Confirm extends Component<ConfirmProps, ConfirmState> {
  #dialog: HTMLDialogElement | null = null;
  #open = () => this.setState({ is_open: true, said: "" }, () => this.#dialog?.showModal());
  #closed = () => this.setState({ is_open: false });
  #act = async () => {
    this.setState({ is_busy: true });
    const next: ConfirmState = { is_busy: false, has_failed: false };
    try {
      announce(next.said = await this.props.act());
    } catch (error) {
      next.said = (error as Error).message;
      next.has_failed = true;
    }
    this.setState(next);
  };
  render({ label, title, children, danger, is_offered = true }: ConfirmProps, { is_open, is_busy, said, has_failed }: ConfirmState) {
    return <span>
      {is_offered && <button class={danger ? "danger" : ""} onClick={this.#open}>{label}</button>}
      {is_open && <dialog ref={(it: any) => (this.#dialog = it)} aria-label={title} {...{ onClose: this.#closed }}>
        <h2>{title}</h2>
        {said ? <p class={has_failed ? "failure" : "done"} role="status">{said}</p> : [<div>{children}</div>,
          !token() && <p class="warn">This needs the coordinator's token. Open the address with <code>#t=...</code> that it printed on its terminal; it is also in the file <code>.token</code> beside the store.</p>]}
        <div class="tools">
          <button onClick={() => this.#dialog?.close()}>{said ? "Close" : "Leave it"}</button>
          {!said && <button class={danger ? "danger" : "main"} disabled={is_busy || !token()} onClick={this.#act}>{is_busy ? "Doing it …" : label}</button>}
        </div>
      </dialog>}
    </span>;
  }
}

// --- tables -----------------------------------------------------------------------------------------

type Value = string | number | null | undefined;

export interface Column<Row> {
  key: string;
  /// By default the key, in words.
  label?: string;
  /// The value for sorting, filtering and CSV; by default the row's field with this key.
  value?: (row: Row) => Value;
  /// The displayed content; by default the value as `usual` shows it.
  show?: (row: Row) => Children;
  /// By default true if all its values are numbers.
  numeric?: boolean;
  title?: string;
}

interface TableProps<Row> {
  /// Prefix of the table's state in the address, such as "w": w.sort=-busy, w.q=node, w.page=2.
  /// Tables of the same view need different prefixes.
  name: string;
  caption: string;
  /// For a column without other settings, the key is enough.
  columns: (Column<Row> | string)[];
  rows: Row[];
  /// Default order: "-busy" puts the largest value first. The address may change it.
  sort?: string;
  /// A stable name of the row, so that focus stays with it; by default the value of its first
  /// column.
  row_key?: (row: Row) => string | number;
  row_class?: (row: Row) => string | false;
  empty?: Children;
  page_size?: number;
}

/// Formats a value according to its column's name: ids link to their pages, times are in the
/// reader's time zone.
function usual(column: string, value: Value): Children {
  if (!is_known(value)) return "–";
  if (column === "at") return <time dateTime={String(value)} title={`${value} UTC`}>{when(String(value))}</time>;
  if (column === "id" && /^[er]\d/.test(String(value))) return link(String(value));
  if (typeof value !== "number") return value;
  if (/^(best_?)?(candidate)?$|^parent$/.test(column)) return link("c" + value);
  if (column === "design") return link("d" + value);
  return column === "seed" ? value : number(value);
}

function value_of<Row>({ key, value }: Column<Row>, row: Row): Value {
  return value ? value(row) : (row as any)[key];
}

/// Unknown values come last in both directions.
function sorted<Row>(columns: Column<Row>[], rows: Row[], sort: string): Row[] {
  const sign = sort[0] === "-" ? -1 : 1;
  const column = columns.find(({ key }) => key === sort.replace(/^-/, ""));
  if (!column) return rows;
  return rows.map((row) => ({ row, value: value_of(column, row) })).sort(({ value: a }, { value: b }) =>
    !is_known(a) || !is_known(b) ? Number(is_known(b)) - Number(is_known(a))
      : sign * (typeof a === "number" && typeof b === "number" ? a - b : String(a).localeCompare(String(b), "en", { numeric: true })))
    .map((one) => one.row);
}

/// A table with sorting, filtering and pages.
export function Table<Row>({ name, caption, columns: given, rows, row_key, row_class, empty = "Nothing here yet.", sort: first_sort = "", page_size = 25 }: TableProps<Row>) {
  if (rows.length === 0) return <Empty>{empty}</Empty>;
  const columns: Column<Row>[] = given.map((one) => typeof one === "string" ? { key: one } : one);
  const { query } = current_route();
  const set = (what: string, value: Query[string]) => set_query({ [name + ".page"]: null, [`${name}.${what}`]: value });
  const sort = query[name + ".sort"] ?? first_sort;
  const filter = query[name + ".q"] ?? "";
  const matching = sorted(columns, rows.filter((row) =>
    columns.some((column) => String(value_of(column, row) ?? "").toLowerCase().includes(filter.toLowerCase()))), sort);
  const pages = Math.max(1, Math.ceil(matching.length / page_size));
  const page = clamp(Number(query[name + ".page"]) || 1, 1, pages);
  const numeric = columns.map((column) => {
    const some = rows.slice(0, 50).map((row) => value_of(column, row)).filter(is_known);
    return column.numeric ?? (some.length > 0 && some.every((value) => typeof value === "number"));
  });
  const turn = (to: number, mark: string, label: string) =>
    <button disabled={to < 1 || to > pages} onClick={() => set("page", to > 1 ? to : null)} aria-label={`${label} page: ${caption}`}>{mark}</button>;
  return <div>
    {(rows.length > 8 || filter) && <div class="tools">
      <input type="search" placeholder="filter" aria-label={`filter: ${caption}`} value={filter} onInput={(event) => set("q", typed(event))} />
      <span class="faint" role="status">{filter ? `${whole(matching.length)} of ${whole(rows.length)}` : count(rows.length, "row")}</span>
      <Quiet label={`CSV: ${caption}`} act={() => save_as(caption.replace(/\W+/g, "-") + ".csv",
        csv([columns.map((one) => one.key), ...matching.map((row) => columns.map((column) => value_of(column, row)))]))}>CSV</Quiet>
    </div>}
    <div class="scroll" tabIndex={0} role="region" aria-label={caption}>
      <table>
        <caption class="unseen">{caption}</caption>
        <thead><tr>{columns.map(({ key, label, title }, i) => {
          const [now, arrow] = sort === key ? ["ascending", "▲"] : sort === "-" + key ? ["descending", "▼"] : ["none", ""];
          // For numbers, the first click sorts the largest values first, because users usually want
          // these.
          const down = arrow ? sort === key : numeric[i];
          return <th scope="col" class={numeric[i] ? "n" : ""} aria-sort={now} title={title}>
            <button onClick={() => set("sort", (down ? "-" : "") + key)}>{label ?? words(key)}<span aria-hidden="true" class="arrow">{arrow}</span></button></th>;
        })}</tr></thead>
        <tbody>{matching.slice((page - 1) * page_size, page * page_size).map((row) =>
          <tr key={String(row_key ? row_key(row) : value_of(columns[0], row))} class={row_class?.(row) || ""}>{columns.map((column, i) =>
            h(i ? "td" : "th", { scope: i ? undefined : "row", class: numeric[i] ? "n" : "" }, (column.show ? column.show(row) : usual(column.key, value_of(column, row))) as JSX.Element))}</tr>)}</tbody>
      </table>
    </div>
    {matching.length === 0 && <Empty>No row has “{filter}”.</Empty>}
    {pages > 1 && <div class="tools pages">
      {turn(page - 1, "‹", "previous")}<span>page {whole(page)} of {whole(pages)}</span>{turn(page + 1, "›", "next")}
    </div>}
  </div>;
}
