// A run seen from above, on a canvas: arena, things, robots and their trails at one instant.

import { Inks } from "./canvas";

export type Place = [number, number];
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

/// Poses by cycle of 0.1 s, the start first; a null: not known.
export interface Track {
  x_mm: (number | null)[];
  y_mm: (number | null)[];
  theta_mrad: (number | null)[];
}

export interface Robot extends Track {
  name?: string;
  /// [cycle, state]: the state from that cycle on. Empty: not known.
  state: [number, number][];
  /// [cycle, what the LEDs show from there on], for robots that light any.
  leds?: [number, string][];
  /// [cycle, how the pose was obtained from there on], of filmed runs.
  kind?: [number, string][];
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
  /// Module that acts, by state.
  behaviours: string[];
  verdict?: string;
  name?: string;
}

/// Okabe-Ito, in the order of the figures: state or robot 0 is blue in all of them.
export const kDistinct = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"];

export type Tint = "state" | "robot" | "leds";

export interface View {
  cycle: number;         ///< may lie between two cycles
  trail_cycles: number;  ///< how long trails are
  tint: Tint;
  chosen: number | null; ///< robot that is followed
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

/// Where something is, in metres and radians, between two cycles on the straight line; null: not known.
export function pose_at(track: Track, cycle: number): { x: number; y: number; theta: number } | null {
  const from = Math.max(0, Math.min(Math.floor(cycle), track.x_mm.length - 1));
  const to = Math.min(from + 1, track.x_mm.length - 1);
  const part = Math.min(1, Math.max(0, cycle - from));
  const known = (at: number) => track.x_mm[at] !== null && track.y_mm[at] !== null && track.theta_mrad[at] !== null;
  if (!known(from)) return null;
  const end = known(to) ? to : from;
  const mix = (values: (number | null)[]) => (values[from]! + part * (values[end]! - values[from]!)) / 1000;
  let turn = (track.theta_mrad[end]! - track.theta_mrad[from]!) / 1000;
  turn = Math.atan2(Math.sin(turn), Math.cos(turn));
  return { x: mix(track.x_mm), y: mix(track.y_mm), theta: track.theta_mrad[from]! / 1000 + part * turn };
}

export function color_of_robot(run: Trajectory, number: number, cycle: number, tint: Tint): Color {
  const robot = run.robots[number];
  if (tint === "state") {
    const state = value_at(robot.state, cycle);
    if (state !== null) return kDistinct[state % kDistinct.length];
  }
  if (tint === "leds") return value_at(robot.leds, cycle) ?? "#000000";
  return kDistinct[number % kDistinct.length];
}

interface Frame { scale: number; left: number; top: number; x0: number; y1: number }

/// How metres become pixels, so that the walls just fit.
export function frame_of(arena: Arena, width: number, height: number): Frame {
  const xs = arena.walls.map(([x]) => x), ys = arena.walls.map(([, y]) => y);
  const [x0, x1, y0, y1] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  const margin = 6;
  const scale = Math.min((width - 2 * margin) / (x1 - x0), (height - 2 * margin) / (y1 - y0));
  return { scale, left: (width - scale * (x1 - x0)) / 2, top: (height - scale * (y1 - y0)) / 2, x0, y1 };
}

/// Height over width of the arena.
export function shape_of(arena: Arena): number {
  const xs = arena.walls.map(([x]) => x), ys = arena.walls.map(([, y]) => y);
  return (Math.max(...ys) - Math.min(...ys)) / (Math.max(...xs) - Math.min(...xs));
}

/// The robot under a place of the canvas, in pixels.
export function robot_at(run: Trajectory, cycle: number, width: number, height: number, x: number, y: number): number | null {
  const frame = frame_of(run.arena, width, height);
  let best: number | null = null, nearest = 24;
  run.robots.forEach((robot, number) => {
    const pose = pose_at(robot, cycle);
    if (!pose) return;
    const [px, py] = at(frame, pose.x, pose.y);
    const distance = Math.hypot(px - x, py - y);
    if (distance < Math.max(nearest, frame.scale * reach_of(run.body)) && distance < (best === null ? Infinity : nearest)) {
      best = number;
      nearest = distance;
    }
  });
  return best;
}

function at(frame: Frame, x: number, y: number): Place {
  return [frame.left + frame.scale * (x - frame.x0), frame.top + frame.scale * (frame.y1 - y)];
}

function reach_of(outline: Outline): number {
  if (outline.radius_m) return outline.radius_m;
  return Math.max(...(outline.corners ?? [[0.1, 0.1]]).map(([x, y]) => Math.hypot(x, y)));
}

function polygon(pen: CanvasRenderingContext2D, points: Place[]): void {
  pen.beginPath();
  points.forEach(([x, y], i) => (i === 0 ? pen.moveTo(x, y) : pen.lineTo(x, y)));
  pen.closePath();
}

/// A path around an outline that stands somewhere.
function around(pen: CanvasRenderingContext2D, frame: Frame, outline: Outline, x: number, y: number, theta: number): void {
  if (outline.radius_m) {
    pen.beginPath();
    pen.arc(...at(frame, x, y), frame.scale * outline.radius_m, 0, 2 * Math.PI);
    return;
  }
  const [cos, sin] = [Math.cos(theta), Math.sin(theta)];
  polygon(pen, (outline.corners ?? []).map(([a, b]) => at(frame, x + cos * a - sin * b, y + sin * a + cos * b)));
}

/// What does not move, once for a size: the floor is data, the same in light and dark.
export function draw_place(pen: CanvasRenderingContext2D, arena: Arena, width: number, height: number,
                           images: Map<string, HTMLImageElement>): void {
  const frame = frame_of(arena, width, height);
  const walls = arena.walls.map(([x, y]) => at(frame, x, y));
  pen.save();
  polygon(pen, walls);
  pen.fillStyle = arena.floor;
  pen.fill();
  pen.clip();
  for (const patch of arena.patches) {
    pen.fillStyle = patch.color ?? arena.floor;
    const image = patch.image ? images.get(patch.image) : undefined;
    if (patch.centre && patch.radius_m) {
      pen.beginPath();
      pen.arc(...at(frame, ...patch.centre), frame.scale * patch.radius_m, 0, 2 * Math.PI);
      pen.fill();
    } else if (patch.corners) {
      const corners = patch.corners.map(([x, y]) => at(frame, x, y));
      if (image?.complete) {
        const xs = corners.map(([x]) => x), ys = corners.map(([, y]) => y);
        pen.imageSmoothingEnabled = false;
        pen.drawImage(image, Math.min(...xs), Math.min(...ys), Math.max(...xs) - Math.min(...xs), Math.max(...ys) - Math.min(...ys));
      } else {
        polygon(pen, corners);
        pen.fill();
      }
    }
  }
  pen.restore();
  polygon(pen, walls);
  pen.strokeStyle = "#7a5c3a";
  pen.lineWidth = 4;
  pen.lineJoin = "round";
  pen.stroke();
  for (const thing of arena.obstacles) {
    around(pen, frame, thing, thing.x_m, thing.y_m, thing.theta_rad);
    pen.fillStyle = "#7a5c3a";
    pen.fill();
  }
  for (const light of arena.lights) draw_light(pen, at(frame, light.x_m, light.y_m));
}

function draw_light(pen: CanvasRenderingContext2D, [x, y]: Place): void {
  pen.beginPath();
  pen.arc(x, y, 5, 0, 2 * Math.PI);
  pen.fillStyle = "#f0e442";
  pen.fill();
  pen.strokeStyle = "#000";
  pen.lineWidth = 1;
  pen.stroke();
  for (let ray = 0; ray < 8; ++ray) {
    const [cos, sin] = [Math.cos(ray * Math.PI / 4), Math.sin(ray * Math.PI / 4)];
    pen.beginPath();
    pen.moveTo(x + 7 * cos, y + 7 * sin);
    pen.lineTo(x + 10 * cos, y + 10 * sin);
    pen.stroke();
  }
}

function draw_trail(pen: CanvasRenderingContext2D, frame: Frame, robot: Track, view: View, color: Color): void {
  if (view.trail_cycles === 0) return;
  const last = Math.min(Math.floor(view.cycle), robot.x_mm.length - 1);
  const first = Math.max(0, last - view.trail_cycles);
  const line = () => {
    pen.beginPath();
    let is_open = false;
    for (let cycle = first; cycle <= last; ++cycle) {
      const x = robot.x_mm[cycle], y = robot.y_mm[cycle];
      if (x === null || y === null) { is_open = false; continue; }
      const [px, py] = at(frame, x / 1000, y / 1000);
      if (is_open) pen.lineTo(px, py); else pen.moveTo(px, py);
      is_open = true;
    }
    const here = pose_at(robot, view.cycle);
    if (here && is_open) pen.lineTo(...at(frame, here.x, here.y));
    pen.stroke();
  };
  pen.lineJoin = pen.lineCap = "round";
  // A pale rim, so that dark lines are seen on dark patches.
  pen.strokeStyle = "rgba(255,255,255,.55)";
  pen.lineWidth = 3.5;
  line();
  pen.strokeStyle = color;
  pen.lineWidth = 1.75;
  line();
}

/// What moves.
export function draw_run(pen: CanvasRenderingContext2D, run: Trajectory, view: View, width: number, height: number): void {
  const frame = frame_of(run.arena, width, height);
  run.robots.forEach((robot, number) =>
    draw_trail(pen, frame, robot, view, color_of_robot(run, number, view.cycle, view.tint === "leds" ? "robot" : view.tint)));
  for (const thing of run.objects) {
    const pose = pose_at(thing, view.cycle);
    if (!pose) continue;
    around(pen, frame, thing.outline, pose.x, pose.y, pose.theta);
    pen.fillStyle = "#c9b28a";
    pen.fill();
    pen.strokeStyle = "#4a3820";
    pen.lineWidth = 1.5;
    pen.stroke();
  }
  run.robots.forEach((robot, number) => draw_robot(pen, frame, run, number, robot, view));
}

function draw_robot(pen: CanvasRenderingContext2D, frame: Frame, run: Trajectory, number: number, robot: Robot, view: View): void {
  const pose = pose_at(robot, view.cycle);
  if (!pose) return;
  const kind = value_at(robot.kind, view.cycle);
  const [x, y] = at(frame, pose.x, pose.y);
  const body = frame.scale * reach_of(run.body);
  pen.save();
  // Where a camera did not see it, the body is hollow and its rim dashed.
  const is_seen = kind === null || kind === "measured";
  around(pen, frame, run.body, pose.x, pose.y, pose.theta);
  pen.fillStyle = color_of_robot(run, number, view.cycle, view.tint);
  if (is_seen) pen.fill();
  pen.strokeStyle = "#fff";
  pen.lineWidth = view.chosen === number ? 5 : 3;
  pen.stroke();
  pen.strokeStyle = is_seen ? "#000" : color_of_robot(run, number, view.cycle, view.tint);
  pen.setLineDash(is_seen ? [] : [4, 3]);
  pen.lineWidth = view.chosen === number ? 2.5 : 1;
  pen.stroke();
  pen.setLineDash([]);
  // The heading: a wedge that points forward.
  const tip = 0.62 * body, back = 0.3 * body;
  const [cos, sin] = [Math.cos(pose.theta), -Math.sin(pose.theta)];
  polygon(pen, [[x + tip * cos, y + tip * sin], [x - back * cos - 0.32 * body * sin, y - back * sin + 0.32 * body * cos],
                [x - back * cos + 0.32 * body * sin, y - back * sin - 0.32 * body * cos]]);
  pen.fillStyle = "#fff";
  pen.fill();
  pen.strokeStyle = "#000";
  pen.lineWidth = 0.75;
  pen.stroke();
  if (body >= 8) {
    pen.font = `${Math.max(9, Math.min(13, 0.45 * body))}px sans-serif`;
    pen.textAlign = "center";
    pen.textBaseline = "middle";
    pen.fillStyle = "#000";
    pen.fillText(String(number), x + 0.04 * body * cos, y + 0.04 * body * sin);
  }
  pen.restore();
}

/// The score so far of several runs, with the instant.
export function draw_scores(pen: CanvasRenderingContext2D, runs: Trajectory[], cycle: number, width: number, height: number,
                            { ink, faint, line, font }: Inks): void {
  let low = 0, high = 0;
  for (const run of runs)
    for (const value of run.score_at) if (value !== null) { low = Math.min(low, value); high = Math.max(high, value); }
  if (low === high) high = low + 1;
  const longest = Math.max(1, ...runs.map((run) => run.cycles));
  const to_y = (value: number) => 4 + (height - 8) * (1 - (value - low) / (high - low));
  const to_x = (at: number) => width * at / longest;
  pen.strokeStyle = line;
  pen.lineWidth = 1;
  for (const value of [low, high]) {
    pen.beginPath();
    pen.moveTo(0, to_y(value));
    pen.lineTo(width, to_y(value));
    pen.stroke();
  }
  runs.forEach((run, number) => {
    pen.beginPath();
    let is_open = false;
    const step = Math.max(1, Math.floor(run.score_at.length / (2 * width)));
    for (let at = 0; at < run.score_at.length; at += step) {
      const value = run.score_at[at];
      if (value === null) { is_open = false; continue; }
      if (is_open) pen.lineTo(to_x(at), to_y(value)); else pen.moveTo(to_x(at), to_y(value));
      is_open = true;
    }
    pen.setLineDash([[], [6, 3], [2, 2], [8, 3, 2, 3]][number % 4]);
    pen.strokeStyle = number === 0 ? ink : kDistinct[(number - 1) % 4];
    pen.lineWidth = 1.5;
    pen.stroke();
  });
  pen.setLineDash([]);
  pen.strokeStyle = kDistinct[1];
  pen.lineWidth = 2;
  pen.beginPath();
  pen.moveTo(to_x(cycle), 0);
  pen.lineTo(to_x(cycle), height);
  pen.stroke();
  pen.fillStyle = faint;
  pen.font = `11px ${font}`;
  pen.textBaseline = "bottom";
  pen.textAlign = "left";
  pen.fillText(String(Number(high.toPrecision(6))), 2, to_y(high) + 13);
  if (low !== 0) pen.fillText(String(Number(low.toPrecision(6))), 2, to_y(low) - 1);
}
