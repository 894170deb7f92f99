// Parallel coordinates: drawing, selection by brushes, and the line under the pointer.

import { Pen, Point, viridis } from "./canvas";
import { clamp, in_order, is_known, number, words } from "./format";
import { Cell } from "./types";

/// The answer of designs/d3/parameters: columns with one value per candidate.
export interface Sample {
  v: number;
  total: number;
  candidates: number[];
  iteration: number[];
  mean: (number | null)[];
  runs: number[];
  elite: (boolean | number)[];
  parameters: Record<string, Cell[]>;
}

/// A parameter's scale. Numbers lie between low and high; words are evenly spaced.
export interface Axis {
  name: string;
  values: Cell[];
  words: string[] | null;
  low: number;
  high: number;
}

/// From and to, as positions on the axis; 0 is its lower end.
export interface Brush { from: number; to: number }

const kTop = 34, kFoot = 40, kSide = 74;

/// Whether candidates differ in it; a missing value counts as a value, too.
export function varies(values: Cell[]): boolean {
  return values.some((value) => value !== values[0]);
}

export function axis_of(name: string, values: Cell[]): Axis {
  const known = values.filter(is_known);
  const of_words = (words: string[]) => ({ name, values, words, low: 0, high: Math.max(1, words.length - 1) });
  if (known.some((value) => typeof value !== "number")) return of_words(in_order(known.map(String)));
  const numbers = known.length ? known as number[] : [0, 1];
  const low = numbers.reduce((a, b) => Math.min(a, b)), high = numbers.reduce((a, b) => Math.max(a, b));
  // A few whole numbers are treated as words.
  if (known.length && high - low <= 8 && numbers.every(Number.isInteger))
    return of_words(Array.from({ length: high - low + 1 }, (_, i) => String(low + i)));
  const room = low === high ? 0.5 : 0;
  return { name, values, words: null, low: low - room, high: high + room };
}

/// A value's position on an axis, 0 to 1.
export function part_of({ words, low, high }: Axis, value: Cell): number {
  return ((words ? words.indexOf(String(value)) : Number(value)) - low) / (high - low);
}

export function value_of_part({ low, high }: Axis, part: number): number { return low + part * (high - low); }

/// A candidate's position on an axis, 0 to 1; null: it does not have the parameter.
export function part_on(axis: Axis, candidate: number): number | null {
  const value = axis.values[candidate];
  return is_known(value) ? part_of(axis, value) : null;
}

export function text_at(axis: Axis, part: number): string {
  const value = value_of_part(axis, part);
  return axis.words ? axis.words[clamp(Math.round(value), 0, axis.words.length - 1)] : number(value, 3);
}

/// Which candidates lie within all brushes.
export function chosen_by(axes: Axis[], brushes: Record<string, Brush>, count: number): boolean[] {
  const active = axes.filter((one) => brushes[one.name]);
  return Array.from({ length: count }, (_, candidate) => active.every((axis) => {
    const part = part_on(axis, candidate);
    const { from, to } = brushes[axis.name];
    return part !== null && part >= from - 1e-9 && part <= to + 1e-9;
  }));
}

export interface Plot {
  axes: Axis[];
  /// From 0 to 1 for each candidate; null: not known.
  shade: (number | null)[];
  elite: (boolean | number)[];
  chosen: boolean[];
  brushes: Record<string, Brush>;
  /// The line under the pointer.
  met: number | null;
}

export function x_of(axes: Axis[], at: number, width: number): number {
  return axes.length < 2 ? width / 2 : kSide + at * (width - 2 * kSide) / (axes.length - 1);
}

/// The lines of a word are spread slightly, so that they do not all coincide.
function y_of(axis: Axis, candidate: number, height: number): number {
  const part = part_on(axis, candidate);
  if (part === null) return height - 12;
  const length = height - kTop - kFoot;
  const spread = axis.words ? Math.min(10, 0.3 * length / axis.words.length) * (((candidate * 0.618034) % 1) - 0.5) : 0;
  return kTop + (1 - part) * length + spread;
}

export function part_of_y(y: number, height: number): number {
  return clamp(1 - (y - kTop) / (height - kTop - kFoot), 0, 1);
}

/// The axis under the pointer; null: it is between two axes.
export function axis_at(axes: Axis[], x: number, width: number): number | null {
  const at = axes.findIndex((_, i) => Math.abs(x_of(axes, i, width) - x) <= 9);
  return at < 0 ? null : at;
}

/// The candidate whose line is nearest to a point, within a few pixels.
export function line_at({ axes, chosen, elite }: Plot, x: number, y: number, width: number, height: number): number | null {
  if (axes.length < 2) return null;
  const step = (width - 2 * kSide) / (axes.length - 1);
  const at = clamp(Math.floor((x - kSide) / step), 0, axes.length - 2);
  const part = (x - x_of(axes, at, width)) / step;
  if (part < -0.1 || part > 1.1) return null;
  let best: number | null = null, nearest = 7;
  chosen.forEach((is_chosen, candidate) => {
    if (!is_chosen) return;
    const here = (1 - part) * y_of(axes[at], candidate, height) + part * y_of(axes[at + 1], candidate, height);
    const distance = Math.abs(here - y) - (elite[candidate] ? 1 : 0);
    if (distance < nearest) { nearest = distance; best = candidate; }
  });
  return best;
}

export function draw_parallel(pen: Pen, plot: Plot): void {
  const { width, height, inks } = pen;
  const { axes, chosen, elite, shade, met } = plot;
  const line = (candidate: number) => pen.path(axes.map((axis, at): Point => [x_of(axes, at, width), y_of(axis, candidate, height)]));
  const bold = (candidate: number, color: string, thick: number) => line(candidate).stroke(inks.paper, thick + 2).stroke(color, thick);
  pen.to.lineJoin = "round";
  pen.to.globalAlpha = 0.25;
  chosen.forEach((is_chosen, at) => { if (!is_chosen) line(at).stroke(inks.line); });
  pen.to.globalAlpha = chosen.length > 300 ? 0.45 : 0.75;
  chosen.forEach((is_chosen, at) => {
    const part = shade[at];
    if (is_chosen && !elite[at]) line(at).stroke(part === null ? inks.faint : viridis(pen.dark ? 1 - part : part));
  });
  pen.to.globalAlpha = 1;
  chosen.forEach((is_chosen, at) => { if (is_chosen && elite[at]) bold(at, "#d55e00", 2); });
  if (met !== null) bold(met, inks.ink, 3);
  axes.forEach((axis, at) => draw_axis(pen, axis, plot.brushes[axis.name], x_of(axes, at, width), at));
}

function draw_axis(pen: Pen, axis: Axis, brush: Brush | undefined, x: number, at: number): void {
  const { height, inks } = pen;
  const foot = height - kFoot;
  const y_at = (part: number) => foot - part * (foot - kTop);
  pen.path([[x, kTop], [x, foot]]).stroke(inks.ink, 1.25);
  if (brush) pen.box("rgba(0,114,178,.35)", x - 8, y_at(brush.to) - 1, 16, y_at(brush.from) - y_at(brush.to) + 2).stroke(inks.ink, 1.25);
  const write = (text: string, y: number, color = inks.ink, font?: string) => pen.say(text, x, y, "center", color, font, true);
  // Names of neighbouring axes are at two heights, so that long ones have room.
  write(axis.name, at % 2 ? 8 : 20, inks.ink, "600 12px");
  if (axis.words) axis.words.forEach((word, i) => write(words(word), y_at(i / axis.high)));
  else for (const part of [0, 0.5, 1]) write(text_at(axis, part), y_at(part));
  if (!axis.values.every(is_known)) write("not used", height - 12, inks.faint);
}
