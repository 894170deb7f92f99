// A run seen from above, on a canvas: arena, objects, robots and their trails at one instant.

import { Pen, Point as Place } from "./canvas";
import { clamp } from "./format";

export type Color = string;

/// A disc or a polygon in its own frame, metres.
export interface Outline { radius_m?: number; corners?: Place[] }

export interface Arena {
  walls: Place[];
  floor: Color;
  patches: { color?: Color; centre?: Place; radius_m?: number; corners?: Place[]; image?: string }[];
  obstacles: (Outline & { x_m: number; y_m: number; theta_rad: number })[];
  lights: { x_m: number; y_m: number }[];
}

/// Poses by cycle of 0.1 s, beginning with the start; null: not known.
export interface Track {
  x_mm: (number | null)[];
  y_mm: (number | null)[];
  theta_mrad: (number | null)[];
}

export interface Robot extends Track {
  name?: string;
  /// [cycle, state]: the state holds from that cycle on. Empty: not known.
  state: [number, number][];
  /// [cycle, LED colours from that cycle on], for robots that use LEDs.
  leds?: [number, string][];
  /// [cycle, how the poses from that cycle on were obtained], for filmed runs.
  kind?: [number, string][];
}

/// A check that a real run must pass before its score counts.
export interface Check {
  name: string;
  subject: string;         ///< the robot or camera; "" for the run
  outcome: "passed" | "warned" | "failed" | "not run";
  value: number | null;
  limit: number | null;
  unit: string;
  catches: string;
  reason: string;          ///< why it was not made
}

export interface Trajectory {
  v: number;
  id: string;
  candidate: string | null;
  design: string | null;
  mission: string;
  source: string;
  seed: number | null;
  score: number;
  stored_score: number | null;
  same_bits: boolean | null;
  digest: string | null;
  stored_digest: string | null;
  engine: number;
  arena: Arena;
  body: Outline;
  cycles: number;
  robots: Robot[];
  objects: (Track & { outline: Outline })[];
  score_at: (number | null)[];
  /// Name of the active module, by state.
  behaviours: string[];
  verdict?: string;
  checks?: Check[] | null; ///< for real runs; null: not recorded
  name?: string;
  profiles?: string[];  // not for real runs
}

/// Okabe-Ito colours, in the same order as in the figures: state or robot 0 is always blue.
export const kDistinct = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000"];

export type Tint = "state" | "robot" | "leds";

export interface View {
  cycle: number;         ///< may lie between two cycles
  trail_cycles: number;  ///< length of the trails
  tint: Tint;
  chosen: number | null; ///< the robot that is followed
}

/// The last value of [cycle, value] pairs at or before a cycle.
export function value_at<T>(pairs: [number, T][] | undefined, cycle: number): T | null {
  if (!pairs || pairs.length === 0) return null;
  let low = 0, high = pairs.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (pairs[middle][0] <= cycle) low = middle; else high = middle - 1;
  }
  return pairs[low][0] <= cycle ? pairs[low][1] : null;
}

/// In metres and radians.
export interface Pose { x: number; y: number; theta: number }

/// The interpolated pose between two cycles, on a straight line; null: not known.
export function pose_at(track: Track, cycle: number): Pose | null {
  const { x_mm, y_mm, theta_mrad } = track;
  const last = x_mm.length - 1;
  const from = clamp(Math.floor(cycle), 0, last);
  const known = (at: number) => x_mm[at] !== null && y_mm[at] !== null && theta_mrad[at] !== null;
  if (!known(from)) return null;
  const to = from < last && known(from + 1) ? from + 1 : from;
  const part = clamp(cycle - from, 0, 1);
  const mix = (values: (number | null)[]) => (values[from]! + part * (values[to]! - values[from]!)) / 1000;
  const turn = (theta_mrad[to]! - theta_mrad[from]!) / 1000;
  return { x: mix(x_mm), y: mix(y_mm), theta: theta_mrad[from]! / 1000 + part * Math.atan2(Math.sin(turn), Math.cos(turn)) };
}

export function color_of_robot(run: Trajectory, number: number, { cycle, tint }: View): Color {
  const robot = run.robots[number];
  if (tint === "leds") return value_at(robot.leds, cycle) ?? "#000";
  return kDistinct[((tint === "state" ? value_at(robot.state, cycle) : null) ?? number) % kDistinct.length];
}

/// Smallest and largest x, smallest and largest y.
function bounds(places: Place[]): [number, number, number, number] {
  const xs = places.map(([x]) => x), ys = places.map(([, y]) => y);
  return [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
}

/// Maps metres to pixels, so that the walls just fit.
class Frame {
  readonly scale: number;
  #left: number;
  #bottom: number;
  constructor(arena: Arena, width: number, height: number) {
    const [x0, x1, y0, y1] = bounds(arena.walls);
    const margin = 12;
    this.scale = Math.min((width - margin) / (x1 - x0), (height - margin) / (y1 - y0));
    this.#left = (width - this.scale * (x1 + x0)) / 2;
    this.#bottom = (height + this.scale * (y1 + y0)) / 2;
  }
  at = ([x, y]: Place): Place => [this.#left + this.scale * x, this.#bottom - this.scale * y];
}

/// Height divided by width of the arena.
export function shape_of(arena: Arena): number {
  const [x0, x1, y0, y1] = bounds(arena.walls);
  return (y1 - y0) / (x1 - x0);
}

/// The robot at a position on the canvas, in pixels.
export function robot_at(run: Trajectory, cycle: number, width: number, height: number, x: number, y: number): number | null {
  const frame = new Frame(run.arena, width, height);
  const distances = run.robots.map((robot) => {
    const pose = pose_at(robot, cycle);
    if (!pose) return Infinity;
    const [px, py] = frame.at([pose.x, pose.y]);
    return Math.hypot(px - x, py - y);
  });
  const nearest = Math.min(...distances);
  return nearest < Math.max(24, frame.scale * reach_of(run.body)) ? distances.indexOf(nearest) : null;
}

function reach_of({ radius_m, corners }: Outline): number {
  return radius_m || Math.max(...(corners ?? [[0.1, 0.1]]).map(([x, y]) => Math.hypot(x, y)));
}

/// A path around an outline at a pose.
function around(pen: Pen, frame: Frame, { radius_m, corners = [] }: Outline, x: number, y: number, theta: number): Pen {
  if (radius_m) return pen.disc(frame.at([x, y]), frame.scale * radius_m);
  const [cos, sin] = [Math.cos(theta), Math.sin(theta)];
  return pen.path(corners.map(([a, b]) => frame.at([x + cos * a - sin * b, y + sin * a + cos * b])), true);
}

/// Draws everything that does not move. The floor is data, so it has the same colours in light and
/// dark mode.
export function draw_place(pen: Pen, arena: Arena, images: Map<string, HTMLImageElement>): void {
  const frame = new Frame(arena, pen.width, pen.height);
  const walls = arena.walls.map(frame.at);
  pen.to.save();
  pen.path(walls, true).fill(arena.floor).to.clip();
  for (const { color = arena.floor, centre: [x, y] = [0, 0], image = "", ...outline } of arena.patches) {
    const picture = images.get(image);
    if (outline.corners && picture?.complete) {
      const [x0, x1, y0, y1] = bounds(outline.corners.map(frame.at));
      pen.to.imageSmoothingEnabled = false;
      pen.to.drawImage(picture, x0, y0, x1 - x0, y1 - y0);
    } else {
      around(pen, frame, outline, x, y, 0).fill(color);
    }
  }
  pen.to.restore();
  pen.to.lineJoin = "round";
  pen.path(walls, true).stroke("#7a5c3a", 4);
  for (const thing of arena.obstacles) around(pen, frame, thing, thing.x_m, thing.y_m, thing.theta_rad).fill("#7a5c3a");
  for (const { x_m, y_m } of arena.lights) {
    const place = frame.at([x_m, y_m]);
    pen.disc(place, 5).fill("#f0e442").stroke("#000");
    // The eight rays are a ring of dashes.
    pen.disc(place, 8.5).stroke("#000", 3, [1, 2 * Math.PI * 8.5 / 8 - 1]);
  }
}

function draw_trail(pen: Pen, frame: Frame, { x_mm, y_mm }: Track, here: Pose | null, view: View, color: Color): void {
  const last = Math.min(Math.floor(view.cycle), x_mm.length - 1);
  const points: (Place | null)[] = [];
  for (let cycle = Math.max(0, last - view.trail_cycles); cycle <= last; ++cycle) {
    const x = x_mm[cycle], y = y_mm[cycle];
    points.push(x === null || y === null ? null : frame.at([x / 1000, y / 1000]));
  }
  if (here && points[points.length - 1]) points.push(frame.at([here.x, here.y]));
  pen.to.lineJoin = pen.to.lineCap = "round";
  // A pale edge makes dark lines visible on dark patches.
  pen.path(points).stroke("rgba(255,255,255,.55)", 3.5).stroke(color, 1.75);
}

/// Draws everything that moves.
export function draw_run(pen: Pen, run: Trajectory, view: View): void {
  const frame = new Frame(run.arena, pen.width, pen.height);
  const poses = run.robots.map((robot) => pose_at(robot, view.cycle));
  if (view.trail_cycles) run.robots.forEach((robot, number) => draw_trail(pen, frame, robot, poses[number], view,
    color_of_robot(run, number, view.tint === "leds" ? { ...view, tint: "robot" } : view)));
  for (const thing of run.objects) {
    const pose = pose_at(thing, view.cycle);
    if (pose) around(pen, frame, thing.outline, pose.x, pose.y, pose.theta).fill("#c9b28a").stroke("#4a3820", 1.5);
  }
  poses.forEach((pose, number) => { if (pose) draw_robot(pen, frame, run, number, pose, view); });
}

function draw_robot(pen: Pen, frame: Frame, run: Trajectory, number: number, pose: Pose, view: View): void {
  const reach = reach_of(run.body);
  const color = color_of_robot(run, number, view);
  const is_chosen = view.chosen === number;
  // Where the cameras did not see the robot, its body is hollow with a dashed edge.
  const is_seen = (value_at(run.robots[number].kind, view.cycle) ?? "measured") === "measured";
  around(pen, frame, run.body, pose.x, pose.y, pose.theta);
  if (is_seen) pen.fill(color);
  pen.stroke("#fff", is_chosen ? 5 : 3).stroke(is_seen ? "#000" : color, is_chosen ? 2.5 : 1, is_seen ? [] : [4, 3]);
  // A wedge that points in the robot's direction.
  const corners: Place[] = [[0.62 * reach, 0], [-0.3 * reach, 0.32 * reach], [-0.3 * reach, -0.32 * reach]];
  around(pen, frame, { corners }, pose.x, pose.y, pose.theta).fill("#fff").stroke("#000", 0.75);
  const body = frame.scale * reach;
  if (body >= 8) pen.say(String(number), ...frame.at([pose.x, pose.y]), "center", "#000", `${clamp(0.45 * body, 9, 13)}px`);
}

/// Draws the scores of several runs up to now, with a mark at the current instant.
export function draw_scores(pen: Pen, runs: Trajectory[], cycle: number): void {
  const { width, height, inks } = pen;
  const values = runs.flatMap((run) => run.score_at.filter((value): value is number => value !== null));
  const low = values.reduce((a, b) => Math.min(a, b), 0);
  const high = values.reduce((a, b) => Math.max(a, b), 0) || (low ? 0 : 1);
  const longest = Math.max(1, ...runs.map((run) => run.cycles));
  const to_y = (value: number) => 4 + (height - 8) * (1 - (value - low) / (high - low));
  const to_x = (at: number) => width * at / longest;
  for (const value of [low, high]) pen.path([[0, to_y(value)], [width, to_y(value)]]).stroke(inks.line);
  runs.forEach(({ score_at }, number) => {
    const step = Math.max(1, Math.floor(score_at.length / (2 * width)));
    const curve: (Place | null)[] = [];
    for (let at = 0; at < score_at.length; at += step) {
      const value = score_at[at];
      curve.push(value === null ? null : [to_x(at), to_y(value)]);
    }
    pen.path(curve).stroke(number ? kDistinct[(number - 1) % 4] : inks.ink, 1.5, [[], [6, 3], [2, 2], [8, 3, 2, 3]][number % 4]);
  });
  pen.path([[to_x(cycle), 0], [to_x(cycle), height]]).stroke(kDistinct[1], 2);
  pen.say(String(Number(high.toPrecision(6))), 2, to_y(high) + 7, "left");
  if (low) pen.say(String(Number(low.toPrecision(6))), 2, to_y(low) - 7, "left");
}
