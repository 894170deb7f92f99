import { Component, h } from "preact";
import { ApiError, ask, path_of } from "./api";
import { Failure, save_as, Table } from "./components";
import { Get } from "./get";
import { parse_csv } from "./format";

interface FigureProps {
  /// "c1"
  c: string;
  /// As `swarmsmith figure KIND`.
  kind: string;
  options?: Record<string, string | number | null | undefined>;
  /// What it shows, for the table's caption and for who cannot see it.
  name: string;
  version?: string | number;
  /// Called with the picture when it stands in the page.
  placed?: (svg: SVGSVGElement) => void;
  /// In place of the server's sentence when there is nothing to draw.
  missing?: (error: ApiError) => JSX.Element;
  /// Millimetres; else as wide as there is room for.
  width?: number;
}

function figure_path({ c, kind, options }: FigureProps, ending: string, width: number | null): string {
  return path_of(`${c}/figures/${kind}.${ending}`, { ...options, width: width && `${width}mm` });
}

/// Buttons that save a figure as it goes to a paper, and its numbers.
export class Files extends Component<FigureProps, { error: ApiError | null }> {
  state = { error: null };
  private async save(ending: string, type: string, width: number | null) {
    try {
      save_as(`${this.props.kind}.${ending}`, type, (await ask(figure_path(this.props, ending, width))).text);
    } catch (error) {
      this.setState({ error: error as ApiError });
    }
  }
  render() {
    const { name } = this.props;
    const { error } = this.state;
    return <span class="files">
      <button class="quiet" aria-label={`SVG: ${name}`} onClick={() => this.save("svg", "image/svg+xml", 175)}>SVG</button>
      <button class="quiet" aria-label={`CSV: ${name}`} onClick={() => this.save("csv", "text/csv", null)}>CSV</button>
      {error && <Failure error={error} />}
    </span>;
  }
}

/// A figure of our C++ writers, with its SVG, CSV and table. It keeps a white ground.
export class Figure extends Component<FigureProps, { table: boolean; width: number; empty: boolean }> {
  state = { table: false, width: 0, empty: false };
  private box: HTMLElement | null = null;

  componentDidMount() { this.setState({ width: this.props.width ?? this.width() }); }

  /// Of the picture in mm, so that its texts have the size of the page's. Few steps: the server
  /// keeps what it has drawn.
  private width(): number {
    const pixels = this.box?.clientWidth ?? 600;
    return [240, 200, 160, 130, 100].find((mm) => mm * 3.78 <= pixels) ?? 84;
  }

  render() {
    const { name, version, placed } = this.props;
    const { table, width, empty } = this.state;
    // What is not there has no SVG either.
    const missing = this.props.missing && ((why: ApiError) => {
      if (!empty) this.setState({ empty: true });
      return this.props.missing!(why);
    });
    const there = () => { if (empty) this.setState({ empty: false }); };
    return <figure class="figure" ref={(e: any) => (this.box = e)}>
      {width > 0 && (table
        ? <Get<string> path={figure_path(this.props, "csv", null)} version={version} missing={missing} render={(text) => { there(); return <CsvTable text={text} name={name} id={this.props.kind} />; }} />
        : <Get<string> path={figure_path(this.props, "svg", width)} version={version} keep missing={missing} render={(text) => { there(); return <Svg text={text} placed={placed} />; }} />)}
      {!empty && <figcaption class="tools">
        <Files c={this.props.c} kind={this.props.kind} options={this.props.options} name={name} />
        <button class="quiet" aria-pressed={table} onClick={() => this.setState({ table: !table })}
          aria-label={`${table ? "as picture" : "as table"}: ${name}`}>{table ? "as picture" : "as table"}</button>
      </figcaption>}
    </figure>;
  }
}

/// A picture of the server's own writers, as elements of the page: a pointer can meet its parts.
export class Svg extends Component<{ text: string; placed?: (svg: SVGSVGElement) => void }, {}> {
  private box: HTMLElement | null = null;
  componentDidMount() { this.place(); }
  componentDidUpdate(before: { text: string }) { if (before.text !== this.props.text) this.place(); }
  shouldComponentUpdate(next: { text: string }) { return next.text !== this.props.text; }
  private place() {
    const picture = new DOMParser().parseFromString(this.props.text, "image/svg+xml").documentElement;
    if (picture.localName !== "svg" || !this.box) return;
    const svg = document.importNode(picture, true) as unknown as SVGSVGElement;
    // As wide as in the file at most, and never wider than the page.
    svg.style.width = svg.getAttribute("width") ?? "";
    svg.removeAttribute("height");
    this.box.replaceChildren(svg);
    this.props.placed?.(svg);
  }
  render() { return <div class="svg" ref={(e: any) => (this.box = e)} />; }
}

/// A table of the server as a table of the page.
export function CsvTable({ text, name, id }: { text: string; name: string; id: string }) {
  const [head, ...rows] = parse_csv(text);
  const numeric = head.map((_, i) => rows.every((row) => row[i] === "" || isFinite(Number(row[i]))));
  return <Table<{ key: string; cells: string[] }> name={"t-" + id} caption={name} rows={rows.map((cells, i) => ({ key: String(i), cells }))}
    row_key={(row) => row.key} page_size={25}
    columns={head.map((label, i) => ({
      key: label, label, numeric: numeric[i],
      value: ({ cells }) => cells[i] === "" ? null : numeric[i] ? Number(cells[i]) : cells[i],
    }))} />;
}
