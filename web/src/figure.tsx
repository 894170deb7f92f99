import { Component, h } from "preact";
import { ApiError, ask, path_of } from "./api";
import { Failure, Quiet, save_as, Table } from "./components";
import { Get } from "./get";
import { parse_csv } from "./format";
import { current_route, Query } from "./route";

interface FigureProps {
  /// Of another campaign than the address names: "c1".
  c?: string;
  /// As `swarmsmith figure KIND`.
  kind: string;
  options?: Query;
  /// What it shows, for the table's caption and for who cannot see it.
  name: string;
  version?: string | number;
  /// Called with the picture when it stands in the page.
  placed?: (svg: SVGSVGElement) => void;
  /// In place of the server's sentence when there is nothing to draw.
  missing?: JSX.Element;
}

function figure_path({ c = current_route().path[0], kind, options }: FigureProps, ending: string, width?: number): string {
  return path_of(`${c}/figures/${kind}.${ending}`, { ...options, width: width && `${width}mm` });
}

/// Buttons that save a figure as it goes to a paper, and its numbers.
export class Files extends Component<FigureProps, { error?: ApiError }> {
  render({ kind, name }: FigureProps, { error }: { error?: ApiError }) {
    const button = (ending: string, width?: number) => <Quiet label={`${ending.toUpperCase()}: ${name}`} act={() =>
      ask(figure_path(this.props, ending, width)).then((one) => save_as(`${kind}.${ending}`, one.data as string), (why) => this.setState({ error: why }))}>
      {ending.toUpperCase()}</Quiet>;
    return <span class="files">{button("svg", 175)}{button("csv")}{error && <Failure error={error} />}</span>;
  }
}

/// A figure of our C++ writers, with its SVG, CSV and table. It keeps a white ground.
export class Figure extends Component<FigureProps, { is_table?: boolean; width?: number }> {
  #box!: HTMLElement;

  /// In mm, so that its texts have the size of the page's. Few steps: the server keeps what it has drawn.
  componentDidMount() {
    this.setState({ width: [240, 200, 160, 130, 100].find((mm) => mm * 3.78 <= this.#box.clientWidth) ?? 84 });
  }

  render(props: FigureProps, { is_table = false, width }: { is_table?: boolean; width?: number }) {
    const { name, kind, version, placed, missing } = props;
    const other = is_table ? "as picture" : "as table";
    return <figure ref={(it: any) => (this.#box = it)}>
      {width && <Get<string> path={is_table ? figure_path(props, "csv") : figure_path(props, "svg", width)} version={version} keep missing={missing} render={(text) => [
        text[0] === "<" ? <Svg text={text} placed={placed} /> : <CsvTable text={text} name={name} id={kind} />,
        <div class="tools"><Files {...props} />
          <Quiet aria-pressed={is_table} act={() => this.setState({ is_table: !is_table })} label={`${other}: ${name}`}>{other}</Quiet></div>]} />}
    </figure>;
  }
}

/// The machine, tree or network of a candidate: "c812".
export function Machine({ of, ...rest }: { of: string } & Partial<FigureProps>) {
  return <Figure kind="machine" options={{ candidate: of }} name={`control software of ${of}`} {...rest} />;
}

interface SvgProps { text: string; placed?: (svg: SVGSVGElement) => void }

/// A picture of the server's own writers, as elements of the page: a pointer can meet its parts.
class Svg extends Component<SvgProps, {}> {
  #box!: HTMLElement;
  componentDidMount() { this.componentDidUpdate(); }
  componentDidUpdate() {
    const picture = new DOMParser().parseFromString(this.props.text, "image/svg+xml").documentElement;
    if (picture.localName !== "svg") return;
    const svg = document.importNode(picture, true) as unknown as SVGSVGElement;
    // As wide as in the file at most, and never wider than the page.
    svg.style.width = svg.getAttribute("width") ?? "";
    svg.removeAttribute("height");
    this.#box.replaceChildren(svg);
    this.props.placed?.(svg);
  }
  shouldComponentUpdate(next: SvgProps) { return next.text !== this.props.text; }
  render() { return <div class="svg" ref={(it: any) => (this.#box = it)} />; }
}

/// A table of the server as a table of the page. Columns whose names are in `first` come first, in its order; what is
/// empty throughout is left out.
export function CsvTable({ text, name, id, first = "" }: { text: string; name: string; id: string; first?: string }) {
  const [head, ...rows] = parse_csv(text), order = first.split(" "), place = (label: string) => (order.indexOf(label) + 99) % 99;
  const columns = head.map((label, i) => ({ label, i })).filter(({ i }) => !first || rows.some((row) => row[i])).sort((a, b) => place(a.label) - place(b.label));
  return <Table<string[]> name={"t-" + id} caption={name} rows={rows} row_key={(row) => rows.indexOf(row)} columns={columns.map(({ label, i }) => {
    const numeric = rows.every((row) => row[i] === "" || isFinite(Number(row[i])));
    return { key: label, label, numeric, value: (row) => row[i] === "" ? null : numeric ? Number(row[i]) : row[i] };
  })} />;
}
