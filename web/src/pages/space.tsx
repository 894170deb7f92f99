// The search space: the values of the candidates, the values that the race kept, and where it
// sampled next.

import { Component, h } from "preact";
import { path_of } from "../api";
import { Canvas } from "../canvas";
import { announce, Choice, Empty, link, Panel, place_of, Table, typed } from "../components";
import { clamp, count, is_known, number, whole, words } from "../format";
import { Figure } from "../figure";
import { Get } from "../get";
import { PageProps } from "../page";
import { Axis, axis_at, axis_of, Brush, chosen_by, draw_parallel, line_at, part_of, part_of_y, Plot, Sample, value_of_part, varies } from "../parallel";
import { go, set_query } from "../route";

const kUsualAxes = 9;
/// With more candidates, figures are drawn only on request, because they read all of them.
const kMuch = 20000;
const kSamples = [300, 1000, 5000];

/// Parameters that vary and that most candidates have, in the order of the space.
function usual({ parameters }: Sample): string[] {
  const known = (name: string) => parameters[name].filter(is_known).length;
  const names = varying(parameters);
  const best = [...names].sort((a, b) => known(b) - known(a)).slice(0, kUsualAxes);
  return names.filter((name) => best.includes(name));
}

function varying(parameters: Sample["parameters"]): string[] { return Object.keys(parameters).filter((name) => varies(parameters[name])); }

/// A brush between two positions on an axis, in any order.
function brush_of(a: number, b: number): Brush { return { from: clamp(Math.min(a, b), 0, 1), to: clamp(Math.max(a, b), 0, 1) }; }

/// "RWM0:10:50,S0:stop:stop": the values at both ends of each brush.
function brushes_of(text: string, axes: Axis[]): Record<string, Brush> {
  const brushes: Record<string, Brush> = {};
  for (const one of text.split(",")) {
    const [name, ...ends] = one.split(":");
    const axis = axes.find((other) => other.name === name);
    const [a, b] = axis ? ends.map((value) => part_of(axis, value)) : [];
    if (isFinite(a) && isFinite(b)) brushes[name] = brush_of(a, b);
  }
  return brushes;
}

function text_of(axes: Axis[], brushes: Record<string, Brush>): string {
  return axes.filter((one) => brushes[one.name]).map((axis) => {
    const { name, words } = axis;
    const [from, to] = [brushes[name].from, brushes[name].to].map((part) => value_of_part(axis, part));
    return words ? `${name}:${words[Math.ceil(from - 1e-9)]}:${words[Math.floor(to + 1e-9)]}` : `${name}:${Number(from.toPrecision(5))}:${Number(to.toPrecision(5))}`;
  }).join(",");
}

/// Shades from 0 (worst) to 1 (best), by rank, so that one outlier does not make all others look
/// equal.
function shade_of(values: (number | null)[]): (number | null)[] {
  const sorted = values.filter((value): value is number => value !== null).sort((a, b) => a - b);
  const first = new Map<number, number>();
  sorted.forEach((value, i) => { if (!first.has(value)) first.set(value, i); });
  return values.map((value) => value === null ? null : sorted.length < 2 ? 1 : first.get(value)! / (sorted.length - 1));
}

export class Space extends Component<PageProps, { asked: number }> {
  state = { asked: 0 };

  render({ params: { c }, query, design: { id, mission, method } }: PageProps, { asked }: { asked: number }) {
    const sample = kSamples.includes(Number(query.sample)) ? Number(query.sample) : 1000;
    return <div>
      <h1>Search space <small>of {link(id)}, {words(mission)}, {method}</small></h1>
      <Get<Sample> path={path_of(`${c}/designs/${id}/parameters`, { sample })} version={asked}
        render={(data) => data.candidates.length === 0
          ? <Empty>No candidate yet: the first iteration draws them.</Empty>
          : Object.keys(data.parameters).length === 0 ? <Empty>This design searches no named parameters.</Empty>
          : <Parallel d={id} data={data} query={query} again={() => this.setState({ asked: asked + 1 })} />} />
    </div>;
  }
}

interface ParallelProps { d: string; data: Sample; query: Record<string, string>; again: () => void }
/// `drag` contains positions on the axis, from 0 to 1.
interface ParallelState { met: number | null; drag: { axis: number; from: number; to: number } | null }

class Parallel extends Component<ParallelProps, ParallelState> {
  state: ParallelState = { met: null, drag: null };
  #width = 0;
  #height = 0;

  #plot(): Plot {
    const { data: { parameters, candidates, elite, mean, iteration }, query } = this.props;
    const { drag, met } = this.state;
    const names = query.p === undefined ? usual(this.props.data) : query.p.split(",").filter((name) => parameters[name]);
    const axes = names.map((name) => axis_of(name, parameters[name]));
    const brushes = brushes_of(query.b ?? "", axes);
    if (drag && axes[drag.axis]) brushes[axes[drag.axis].name] = brush_of(drag.from, drag.to);
    return { axes, brushes, chosen: chosen_by(axes, brushes, candidates.length), elite, met, shade: shade_of(query.colour === "score" ? mean : iteration) };
  }

  #show(names: string[]): void {
    const { axes, brushes } = this.#plot();
    set_query({ p: names.join(",") || "none", b: text_of(axes.filter((one) => names.includes(one.name)), brushes) });
  }

  /// null, or a brush over the whole axis, removes the brush.
  #brush({ name }: Axis, brush: Brush | null): void {
    const { axes, brushes } = this.#plot();
    if (brush && brush.to - brush.from < 1) brushes[name] = brush; else delete brushes[name];
    set_query({ b: text_of(axes, brushes) });
    announce(`${count(chosen_by(axes, brushes, this.props.data.candidates.length).filter(Boolean).length, "candidate")} chosen`);
  }

  // --- the pointer ----------------------------------------------------------------------------------

  #down = ({ offsetX, offsetY, currentTarget, pointerId }: PointerEvent): void => {
    const axis = axis_at(this.#plot().axes, offsetX, this.#width);
    if (axis === null) return;
    (currentTarget as Element).setPointerCapture(pointerId);
    const part = part_of_y(offsetY, this.#height);
    this.setState({ drag: { axis, from: part, to: part }, met: null });
  };

  #move = ({ offsetX, offsetY, currentTarget }: PointerEvent): void => {
    const { drag, met } = this.state;
    if (drag) return this.setState({ drag: { ...drag, to: part_of_y(offsetY, this.#height) } });
    const plot = this.#plot();
    const axis = axis_at(plot.axes, offsetX, this.#width);
    const found = axis === null ? line_at(plot, offsetX, offsetY, this.#width, this.#height) : null;
    (currentTarget as HTMLElement).style.cursor = axis !== null ? "ns-resize" : found !== null ? "pointer" : "default";
    if (found !== met) this.setState({ met: found });
  };

  #up = (): void => {
    const { drag, met } = this.state;
    if (drag) {
      const axis = this.#plot().axes[drag.axis];
      // A click without dragging selects all values again.
      this.setState({ drag: null }, () => this.#brush(axis, Math.abs(drag.from - drag.to) < 0.02 ? null : brush_of(drag.from, drag.to)));
    } else if (met !== null) {
      go(place_of("c" + this.props.data.candidates[met]));
    }
  };

  // --- what is shown --------------------------------------------------------------------------------

  render({ d, data, query, again }: ParallelProps) {
    const plot = this.#plot();
    const { axes, chosen, brushes, met } = plot;
    const { candidates, parameters, total } = data;
    const chosen_count = chosen.filter(Boolean).length;
    const names = Object.keys(parameters);
    const elites = data.elite.filter(Boolean).length;
    const shown = axes.map((one) => one.name);
    const has_brush = Object.keys(brushes).length > 0;
    const show = (label: string, these: string[]) => <button onClick={() => this.#show(these)}>{label}</button>;
    return <div class="grid">
      <Panel wide title="Candidates, one line each" tools={[show("All", names), show("None", []), show("Only varying", varying(parameters)),
        <button onClick={() => set_query({ p: null, b: null })}>Usual</button>,
        <Choice label="Colour by" name="colour" options={[["iteration", ""], ["mean score", "score"]]} />,
        <Choice label="Sample" value={query.sample ?? "1000"} options={kSamples.map((size) => [whole(size), String(size)])} />,
        <button onClick={again}>Ask again</button>]}>
        <p><b>{whole(candidates.length)} of {whole(total)}</b> candidates{candidates.length < total && ", evenly spaced"}; {count(elites, "was an elite", "were elites")} (vermilion, bold).
          {has_brush && [" ", <b data-what="chosen">{whole(chosen_count)}</b>, " in the chosen ranges. ", <button onClick={() => set_query({ b: null })}>All ranges</button>]}</p>
        {axes.length === 0 ? <Empty>No parameter is shown: choose some above.</Empty> : <div class="scroll" tabIndex={0} role="region" aria-label="parallel coordinates">
          <div style={{ minWidth: `${74 + 74 * axes.length}px` }}>
            <Canvas label={`Parallel coordinates of ${axes.length} parameters and ${chosen_count} candidates. Their ranges and values are in the tables below.`}
              height={() => 400} draw={(pen) => { this.#width = pen.width; this.#height = pen.height; draw_parallel(pen, plot); }}
              attributes={{ onPointerDown: this.#down, onPointerMove: this.#move, onPointerUp: this.#up, onPointerLeave: () => this.setState({ met: null }) }} />
          </div></div>}
        <p class="small" role="status">{met === null ? <span class="faint">Drag along an axis to choose a range; click it for all values. Click a line to open its candidate.</span>
          : `c${candidates[met]}: iteration ${data.iteration[met]}, mean ${number(data.mean[met])} of ${count(data.runs[met], "run")}${data.elite[met] ? ", an elite" : ""}`}</p>
        <details><summary>Parameters: {whole(axes.length)} of {whole(names.length)}</summary>
          <div class="boxes">{names.map((name) => <label><input type="checkbox" checked={shown.includes(name)}
            onChange={() => this.#show(names.filter((other) => shown.includes(other) !== (other === name)))} /> {name}</label>)}</div></details>
        {axes.length > 0 && <details><summary>Ranges</summary><div class="ranges">{axes.map((axis) => this.#range(axis, brushes[axis.name]))}</div></details>}
      </Panel>
      {[["sampling", "Where the race looked, by iteration"], ["importance", "How much of the scores each parameter explains"]].map(([kind, title]) =>
        <Panel title={title}>{total > kMuch && query.drawn !== "1"
          ? <button onClick={() => set_query({ drawn: 1 })}>Draw it for all {whole(total)} candidates</button>
          : <Figure kind={kind} options={{ design: d }} name={title} />}</Panel>)}
      <Panel wide title={has_brush ? "Candidates in the chosen ranges" : "Candidates"}>
        <Table name="k" caption="candidates" rows={[...candidates.keys()].filter((at) => chosen[at])} sort="-mean" page_size={15}
          empty="No candidate is in all chosen ranges."
          columns={[
            { key: "candidate", value: (at) => candidates[at] },
            { key: "iteration", value: (at) => data.iteration[at] },
            { key: "mean", label: "mean score", value: (at) => data.mean[at], title: "higher is better" },
            { key: "runs", value: (at) => data.runs[at] },
            { key: "elite", value: (at) => data.elite[at] ? "elite" : "" },
            ...axes.map(({ name, values }) => ({ key: name, label: name, value: (at: number) => values[at] }))]} />
      </Panel>
    </div>;
  }

  #range(axis: Axis, { from, to } = { from: 0, to: 1 }) {
    const { name, words } = axis;
    const field = (end: string, part: number, other: number) => {
      const value = Number(value_of_part(axis, part).toPrecision(5));
      const set = (event: Event) => {
        const now = typed(event) === "" ? NaN : (Number(typed(event)) - axis.low) / (axis.high - axis.low);
        if (isFinite(now)) this.#brush(axis, brush_of(now, other));
      };
      return words
        ? <select aria-label={`${name} ${end}`} onChange={set}>{words.map((word, i) => <option value={String(i)} selected={i === Math.round(value)}>{word}</option>)}</select>
        : <input type="number" step="any" aria-label={`${name} ${end}`} value={String(value)} onChange={set} />;
    };
    return <div role="group" aria-label={`range of ${name}`}><b>{name}</b> {field("from", from, to)} to {field("to", to, from)}</div>;
  }
}
