import { Component, h } from "preact";
import { clamp } from "./format";

export type Point = [number, number];

/// The page's colours in the current theme.
export interface Inks { ink: string; paper: string; faint: string; line: string; soft: string; link: string }

function inks_now(): Inks {
  const style = getComputedStyle(document.documentElement);
  const of = (name: string) => style.getPropertyValue("--" + name).trim();
  return { ink: of("ink"), paper: of("paper"), faint: of("faint"), line: of("line"), soft: of("soft"), link: of("link") };
}

/// Draws on a canvas, in CSS pixels: first make a path, then fill it, stroke it, or both.
export class Pen {
  constructor(readonly to: CanvasRenderingContext2D, readonly width: number, readonly height: number,
              readonly inks: Inks, readonly dark: boolean) {}

  /// A line through points; null interrupts it.
  path(points: (Point | null)[], closed = false): Pen {
    const { to } = this;
    let is_open = false;
    to.beginPath();
    for (const point of points) {
      if (point) if (is_open) to.lineTo(...point); else to.moveTo(...point);
      is_open = !!point;
    }
    if (closed) to.closePath();
    return this;
  }
  disc([x, y]: Point, radius: number): Pen {
    this.to.beginPath();
    this.to.arc(x, y, radius, 0, 2 * Math.PI);
    return this;
  }
  box(color: string, x: number, y: number, width: number, height: number): Pen {
    this.to.beginPath();
    this.to.rect(x, y, width, height);
    return this.fill(color);
  }
  fill(color: string): Pen {
    this.to.fillStyle = color;
    this.to.fill();
    return this;
  }
  stroke(color: string, width = 1, dashes: number[] = []): Pen {
    this.to.strokeStyle = color;
    this.to.lineWidth = width;
    this.to.setLineDash(dashes);
    this.to.stroke();
    return this;
  }
  /// A `rim` in the background colour keeps lines from crossing the text.
  say(text: string, x: number, y: number, align: CanvasTextAlign = "center", color = this.inks.faint, font = "11px", rim = false): void {
    const { to, inks } = this;
    to.font = `${font} ${getComputedStyle(document.body).fontFamily}`;
    to.textBaseline = "middle";
    to.textAlign = align;
    if (rim) {
      to.strokeStyle = inks.paper;
      to.lineWidth = 4;
      to.strokeText(text, x, y);
    }
    to.fillStyle = color;
    to.fillText(text, x, y);
  }
}

interface CanvasProps {
  /// A description of the contents for screen readers.
  label: string;
  /// The height for a width, in CSS pixels.
  height: (width: number) => number;
  /// Called when the function changes, and on each change of size or theme.
  draw: (pen: Pen) => void;
  /// Draws a background that seldom changes; called again when a part of the key changes.
  ground?: (pen: Pen) => void;
  ground_key?: unknown[];
  /// Handlers and attributes of the element.
  attributes?: Record<string, unknown>;
}

/// A canvas as wide as its parent, in the screen's own pixels.
export class Canvas extends Component<CanvasProps, {}> {
  #canvas!: HTMLCanvasElement;
  #below = document.createElement("canvas");
  #key: unknown[] = [];
  #seen = new ResizeObserver(() => this.paint());
  componentDidMount() {
    this.#seen.observe(this.#canvas.parentElement!);
    document.addEventListener("theme", this.paint);
    this.paint();
  }
  componentWillUnmount() {
    this.#seen.disconnect();
    document.removeEventListener("theme", this.paint);
  }
  componentDidUpdate() { this.paint(); }

  paint = () => {
    const { height: height_of, draw, ground, ground_key = [] } = this.props;
    const canvas = this.#canvas;
    const width = Math.floor(canvas.parentElement?.clientWidth ?? 0);
    if (!width) return;
    const height = Math.round(height_of(width));
    const scale = devicePixelRatio;
    const is_dark = document.documentElement.dataset.theme === "dark";
    const pen_of = (it: HTMLCanvasElement) => {
      const [w, h] = [Math.round(width * scale), Math.round(height * scale)];
      if (it.width !== w || it.height !== h) {
        it.width = w;
        it.height = h;
        it.style.width = width + "px";
        it.style.height = height + "px";
      }
      const context = it.getContext("2d")!;
      context.setTransform(scale, 0, 0, scale, 0, 0);
      context.clearRect(0, 0, width, height);
      return new Pen(context, width, height, inks_now(), is_dark);
    };
    const pen = pen_of(canvas);
    if (ground) {
      const key = [width, height, scale, is_dark, ...ground_key];
      if (key.some((part, i) => part !== this.#key[i])) {
        this.#key = key;
        ground(pen_of(this.#below));
      }
      pen.to.drawImage(this.#below, 0, 0, width, height);
    }
    draw(pen);
  };

  render({ label, attributes }: CanvasProps) {
    return <div class="canvas"><canvas role="img" aria-label={label} {...attributes}
      ref={(it?: Element) => { if (it) this.#canvas = it as HTMLCanvasElement; }} /></div>;
  }
}

/// The colour scale of the figures from pale yellow (0) to dark violet (1): viridis, interpolated
/// between five of its colours.
const kViridis = [[253, 231, 37], [94, 201, 98], [33, 145, 140], [59, 82, 139], [68, 1, 84]];
export function viridis(part: number): string {
  const at = clamp(part, 0, 1) * 4;
  const i = Math.min(3, Math.floor(at));
  return `rgb(${kViridis[i].map((from, k) => Math.round(from + (at - i) * (kViridis[i + 1][k] - from)))})`;
}
