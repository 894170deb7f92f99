import { Component, h } from "preact";
import { ApiError, ask, path_of } from "./api";
import { Failure, Quiet, save_as, Table } from "./components";
import { Get } from "./get";
import { parse_csv } from "./format";
import { current_route, Query } from "./route";

interface FigureProps {
  /// The campaign, if it is not the one in the address: "c1".
  c?: string;
  /// As in `swarmsmith figure KIND`.
  kind: string;
  options?: Query;
  /// A description for the table's caption and for screen readers.
  name: string;
  version?: string | number;
  /// Called with the picture after it is inserted into the page.
  placed?: (svg: SVGSVGElement) => void;
  /// Shown instead of the server's message if there is nothing to draw.
  missing?: JSX.Element;
}

function figure_path({ c = current_route().path[0], kind, options }: FigureProps, ending: string, width?: number): string {
  return path_of(`${c}/figures/${kind}.${ending}`, { ...options, width: width && `${width}mm` });
}

/// Buttons that save a figure for a paper, and its numbers.
export class Files extends Component<FigureProps, { error?: ApiError }> {
  render({ kind, name }: FigureProps, { error }: { error?: ApiError }) {
    const button = (ending: string, width?: number) => <Quiet label={`${ending.toUpperCase()}: ${name}`} act={() =>
      ask(figure_path(this.props, ending, width)).then((one) => save_as(`${kind}.${ending}`, one.data as string), (why) => this.setState({ error: why }))}>
      {ending.toUpperCase()}</Quiet>;
    return <span class="files">{button("svg", 175)}{button("csv")}{error && <Failure error={error} />}</span>;
  }
}

/// A figure drawn by the server, with its SVG, CSV and table. It keeps a white background.
export class Figure extends Component<FigureProps, { is_table?: boolean; width?: number }> {
  #box!: HTMLElement;

  /// In mm, so that its texts are as large as those of the page. There are only a few steps,
  /// because the server keeps each drawing.
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

/// A picture drawn by the server, inserted as elements of the page, so that its parts react to the
/// pointer.
class Svg extends Component<SvgProps, {}> {
  #box!: HTMLElement;
  componentDidMount() { this.componentDidUpdate(); }
  componentDidUpdate() {
    const picture = new DOMParser().parseFromString(this.props.text, "image/svg+xml").documentElement;
    if (picture.localName !== "svg") return;
    const svg = document.importNode(picture, true) as unknown as SVGSVGElement;
    // At most as wide as in the file, and never wider than the page.
    svg.style.width = svg.getAttribute("width") ?? "";
    svg.removeAttribute("height");
    this.#box.replaceChildren(svg);
    this.props.placed?.(svg);
  }
  shouldComponentUpdate(next: SvgProps) { return next.text !== this.props.text; }
  render() { return <div class="svg" ref={(it: any) => (this.#box = it)} />; }
}

/// A table from the server as a table of the page. Columns with names in `first` come first, in
/// that order; columns that are completely empty are left out.
export function CsvTable({ text, name, id, first = "" }: { text: string; name: string; id: string; first?: string }) {
  const [head, ...rows] = parse_csv(text), order = first.split(" "), place = (label: string) => (order.indexOf(label) + 99) % 99;
  const columns = head.map((label, i) => ({ label, i })).filter(({ i }) => !first || rows.some((row) => row[i])).sort((a, b) => place(a.label) - place(b.label));
  return <Table<string[]> name={"t-" + id} caption={name} rows={rows} row_key={(row) => rows.indexOf(row)} columns={columns.map(({ label, i }) => {
    const numeric = rows.every((row) => row[i] === "" || isFinite(Number(row[i])));
    return { key: label, label, numeric, value: (row) => row[i] === "" ? null : numeric ? Number(row[i]) : row[i] };
  })} />;
}
