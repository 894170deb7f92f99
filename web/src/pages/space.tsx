// The search space: which values candidates have, which the race kept, and where it looked next.

import { Component, h } from "preact";
import { path_of } from "../api";
import { Canvas, Inks } from "../canvas";
import { announce, Choice, Empty, Panel, Table } from "../components";
import { number, whole } from "../format";
import { Figure } from "../figure";
import { Get } from "../get";
import { Page, PageProps } from "../page";
import { Axis, axis_at, axis_of, Brush, chosen_by, draw_parallel, line_at, part_of_y, Plot, Sample, varies } from "../parallel";
import { go, href, set_query } from "../route";

const kUsualAxes = 9;
/// Figures of more candidates than that are drawn when asked for: they read all of them.
const kMuch = 20000;
const kSamples = [300, 1000, 5000];

function is_dark(): boolean { return document.documentElement.dataset.theme === "dark"; }

/// Those that vary and that most candidates have, in the order of the space.
function usual(sample: Sample): string[] {
  const known = (name: string) => sample.parameters[name].filter((value) => value !== null).length;
  const names = Object.keys(sample.parameters).filter((name) => varies(sample.parameters[name]));
  const best = [...names].sort((a, b) => known(b) - known(a)).slice(0, kUsualAxes);
  return names.filter((name) => best.includes(name));
}

/// "RWM0:10:50,S0:stop:stop", values at both ends.
function brushes_of(text: string | undefined, axes: Axis[]): Record<string, Brush> {
  const brushes: Record<string, Brush> = {};
  for (const one of (text ?? "").split(",")) {
    const [name, from, to] = one.split(":");
    const axis = axes.find((other) => other.name === name);
    if (!axis || to === undefined) continue;
    const part = (value: string) => ((axis.words ? axis.words.indexOf(value) : Number(value)) - axis.low) / (axis.high - axis.low);
    const parts = [part(from), part(to)].sort((a, b) => a - b);
    if (parts.every(isFinite)) brushes[name] = { from: Math.max(0, parts[0]), to: Math.min(1, parts[1]) };
  }
  return brushes;
}

function text_of(axes: Axis[], brushes: Record<string, Brush>): string {
  const value = (axis: Axis, part: number, up: boolean) => {
    const at = axis.low + part * (axis.high - axis.low);
    return axis.words ? axis.words[up ? Math.ceil(at - 1e-9) : Math.floor(at + 1e-9)] : String(Number(at.toPrecision(5)));
  };
  return axes.filter(({ name }) => brushes[name])
    .map((axis) => `${axis.name}:${value(axis, brushes[axis.name].from, true)}:${value(axis, brushes[axis.name].to, false)}`).join(",");
}

/// Parts from 0 (worst) to 1 (best), by rank: one outlier does not make all others alike.
function shade_of(values: (number | null)[]): (number | null)[] {
  const sorted = values.filter((value): value is number => value !== null).sort((a, b) => a - b);
  const first = new Map<number, number>();
  sorted.forEach((value, i) => { if (!first.has(value)) first.set(value, i); });
  return values.map((value) => value === null ? null : sorted.length < 2 ? 1 : first.get(value)! / (sorted.length - 1));
}

class Space extends Component<PageProps, { asked: number }> {
  state = { asked: 0 };

  render() {
    const { params: { c, d }, query, live } = this.props;
    const design = live.campaigns.find((one) => one.c === c)?.designs.find((one) => one.id === d);
    const sample = kSamples.includes(Number(query.sample)) ? Number(query.sample) : 1000;
    return <div>
      <h1>Search space <span class="sub">of <a href={href([c, d])}>{d}</a>{design && `, ${design.mission.replace(/_/g, " ")}, ${design.method}`}</span></h1>
      <Get<Sample> path={path_of(`${c}/designs/${d}/parameters`, { sample })} version={this.state.asked}
        render={(data) => data.candidates.length === 0
          ? <Empty>No candidate yet: the first iteration draws them as soon as the design's turn has come.</Empty>
          : Object.keys(data.parameters).length === 0 ? <Empty>This design searches no named parameters.</Empty>
          : <Parallel c={c} d={d} data={data} query={query} again={() => this.setState({ asked: this.state.asked + 1 })} />} />
    </div>;
  }
}

interface ParallelProps { c: string; d: string; data: Sample; query: Record<string, string>; again: () => void }
interface ParallelState { met: number | null; drag: { axis: number; from: number; to: number } | null }

class Parallel extends Component<ParallelProps, ParallelState> {
  state: ParallelState = { met: null, drag: null };
  private width = 0;
  private height = 0;

  private plot(): Plot {
    const { data, query } = this.props;
    const names = query.p === undefined ? usual(data) : query.p.split(",").filter((name) => data.parameters[name]);
    const axes = names.map((name) => axis_of(name, data.parameters[name]));
    const brushes = brushes_of(query.b, axes);
    const { drag } = this.state;
    if (drag && axes[drag.axis]) brushes[axes[drag.axis].name] = { from: Math.min(drag.from, drag.to), to: Math.max(drag.from, drag.to) };
    return { axes, brushes, chosen: chosen_by(axes, brushes, data.candidates.length), elite: data.elite, met: this.state.met,
      shade: shade_of(query.colour === "score" ? data.mean : data.iteration) };
  }

  private show(names: string[]): void {
    set_query({ p: names.length ? names.join(",") : "none", b: text_of(this.plot().axes.filter(({ name }) => names.includes(name)), this.plot().brushes) });
  }

  private brush(axis: Axis, brush: Brush | null): void {
    const { axes, brushes } = this.plot();
    const next = { ...brushes };
    if (brush) next[axis.name] = brush; else delete next[axis.name];
    set_query({ b: text_of(axes, next) });
    const count = chosen_by(axes, brushes_of(text_of(axes, next), axes), this.props.data.candidates.length).filter(Boolean).length;
    announce(`${whole(count)} candidates chosen`);
  }

  // --- the pointer ----------------------------------------------------------------------------------

  private down = (event: PointerEvent): void => {
    const axis = axis_at(this.plot().axes, event.offsetX, this.width);
    if (axis === null) return;
    (event.currentTarget as Element).setPointerCapture(event.pointerId);
    const part = part_of_y(event.offsetY, this.height);
    this.setState({ drag: { axis, from: part, to: part }, met: null });
  };

  private move = (event: PointerEvent): void => {
    const { drag, met } = this.state;
    if (drag) { this.setState({ drag: { ...drag, to: part_of_y(event.offsetY, this.height) } }); return; }
    const plot = this.plot();
    const canvas = event.currentTarget as HTMLCanvasElement;
    const axis = axis_at(plot.axes, event.offsetX, this.width);
    const found = axis === null ? line_at(plot, event.offsetX, event.offsetY, this.width, this.height) : null;
    canvas.style.cursor = axis !== null ? "ns-resize" : found !== null ? "pointer" : "default";
    if (found !== met) this.setState({ met: found });
  };

  private up = (): void => {
    const { drag, met } = this.state;
    if (drag) {
      const axis = this.plot().axes[drag.axis];
      // A click, not a drag: all values again.
      const brush = Math.abs(drag.from - drag.to) < 0.02 ? null : { from: Math.min(drag.from, drag.to), to: Math.max(drag.from, drag.to) };
      this.setState({ drag: null }, () => this.brush(axis, brush));
    } else if (met !== null) {
      go(href([this.props.c, `c${this.props.data.candidates[met]}`]));
    }
  };

  // --- what is shown --------------------------------------------------------------------------------

  render() {
    const { c, d, data, query } = this.props;
    const plot = this.plot();
    const { axes, chosen, brushes, met } = plot;
    const count = chosen.filter(Boolean).length;
    const names = Object.keys(data.parameters);
    const elites = data.elite.filter(Boolean).length;
    return <div class="grid">
      <Panel wide title="Candidates, a line each" tools={this.tools()}>
        <p><b>{whole(data.candidates.length)} of {whole(data.total)}</b> candidates{data.candidates.length < data.total && ", evenly spaced"};{" "}
          {whole(elites)} {elites === 1 ? "was an elite" : "were elites"} (vermilion, bold).
          {Object.keys(brushes).length > 0 && <span> <b data-what="chosen">{whole(count)}</b> in the chosen ranges. <button onClick={() => set_query({ b: null })}>All ranges</button></span>}</p>
        {axes.length === 0 ? <Empty>No parameter is shown: choose some above.</Empty> : <div class="scroll" tabIndex={0} role="region" aria-label="parallel coordinates">
          <div style={{ minWidth: `${148 + 74 * (axes.length - 1)}px` }}>
            <Canvas label={`Parallel coordinates of ${axes.length} parameters and ${count} candidates. Their ranges and values are in the tables below.`}
              height={() => 400}
              draw={(pen, width, height, inks: Inks) => { this.width = width; this.height = height; draw_parallel(pen, plot, width, height, inks, is_dark()); }}
              attributes={{ onPointerDown: this.down, onPointerMove: this.move, onPointerUp: this.up, onPointerLeave: () => this.setState({ met: null }) }} />
          </div></div>}
        <p class="small" role="status">{met === null ? <span class="faint">Drag along an axis to choose a range; click it for all values. A line leads to its candidate.</span>
          : <span>c{data.candidates[met]}: iteration {data.iteration[met]}, mean {number(data.mean[met])} of {whole(data.runs[met])} runs{data.elite[met] ? ", an elite" : ""}</span>}</p>
        <details><summary>Parameters: {whole(axes.length)} of {whole(names.length)}</summary>
          <div class="boxes">{names.map((name) => <label><input type="checkbox" checked={axes.some((axis) => axis.name === name)}
            onChange={(event) => this.show((event.target as HTMLInputElement).checked
              ? names.filter((other) => other === name || axes.some((axis) => axis.name === other)) : axes.map((axis) => axis.name).filter((other) => other !== name))} />
            {" "}{name}</label>)}</div></details>
        {axes.length > 0 && <details><summary>Ranges</summary><div class="ranges">{axes.map((axis) => this.range(axis, brushes[axis.name]))}</div></details>}
      </Panel>
      {[["sampling", "Where the race looked, by iteration"], ["importance", "How much of the scores goes with each parameter"]].map(([kind, title]) =>
        <Panel title={title}>{data.total > kMuch && query.drawn !== "1"
          ? <button onClick={() => set_query({ drawn: 1 })}>Draw it of all {whole(data.total)} candidates</button>
          : <Figure c={c} kind={kind} options={{ design: d }} name={title} missing={(error) => <Empty>{error.message}</Empty>} />}</Panel>)}
      <Panel wide title={Object.keys(brushes).length ? "Candidates in the chosen ranges" : "Candidates"}>{this.candidates(axes, chosen)}</Panel>
    </div>;
  }

  private tools() {
    const { data, query, again } = this.props;
    const names = Object.keys(data.parameters);
    return <div class="tools">
      <button onClick={() => this.show(names)}>All</button>
      <button onClick={() => this.show([])}>None</button>
      <button onClick={() => this.show(names.filter((name) => varies(data.parameters[name])))}>Only varying</button>
      <button onClick={() => set_query({ p: null, b: null })}>Usual</button>
      <Choice label="Colour by" name="colour" value={query.colour ?? ""} options={[["iteration", ""], ["mean score", "score"]]} />
      <Choice label="Sample" name="sample" value={query.sample ?? "1000"} options={kSamples.map((size) => [whole(size), String(size)])} />
      <button onClick={again}>Ask again</button>
    </div>;
  }

  private range(axis: Axis, brush: Brush | undefined) {
    const { from, to } = brush ?? { from: 0, to: 1 };
    const set = (end: "from" | "to") => (event: Event) => {
      const text = (event.target as HTMLInputElement).value;
      const part = (Number(text) - axis.low) / (axis.high - axis.low);
      if (text === "" || !isFinite(part)) return;
      const next = { from, to, [end]: Math.max(0, Math.min(1, part)) };
      this.brush(axis, next.from <= 0 && next.to >= 1 ? null : { from: Math.min(next.from, next.to), to: Math.max(next.from, next.to) });
    };
    const value = (part: number) => Number((axis.low + part * (axis.high - axis.low)).toPrecision(5));
    const field = (end: "from" | "to", part: number) => axis.words
      ? <select aria-label={`${axis.name} ${end}`} onChange={set(end)}>{axis.words.map((word, i) => <option value={String(i)} selected={i === Math.round(value(part))}>{word}</option>)}</select>
      : <input type="number" step="any" aria-label={`${axis.name} ${end}`} value={String(value(part))} onChange={set(end)} />;
    return <div role="group" aria-label={`range of ${axis.name}`}><b>{axis.name}</b> {field("from", from)} to {field("to", to)}</div>;
  }

  private candidates(axes: Axis[], chosen: boolean[]) {
    const { data } = this.props;
    const rows = data.candidates.map((_, at) => at).filter((at) => chosen[at]);
    return <Table<number> name="k" caption="candidates" rows={rows} sort="-mean" page_size={15}
      empty="No candidate lies in all chosen ranges."
      columns={[
        { key: "candidate", value: (at) => data.candidates[at] },
        { key: "iteration", value: (at) => data.iteration[at] },
        { key: "mean", label: "mean score", value: (at) => data.mean[at], title: "higher is better" },
        { key: "runs", value: (at) => data.runs[at] },
        { key: "elite", value: (at) => data.elite[at] ? "elite" : "" },
        ...axes.map((axis) => ({ key: axis.name, value: (at: number) => axis.values[at] ?? null })),
      ]} />;
  }
}

export const space: Page = { pattern: ":c/:d/space", title: ({ d }) => `search space of ${d}`, view: Space,
  nav: { label: "Search space", letter: "p", path: ({ c, d }) => d ? [c, d, "space"] : null } };
