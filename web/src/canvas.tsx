import { Component, h } from "preact";

/// The page's colours as the theme has them now, for canvases.
export interface Inks { ink: string; paper: string; faint: string; line: string; soft: string; link: string; warn: string; font: string }

export function inks(): Inks {
  const style = getComputedStyle(document.documentElement);
  const of = (name: string) => style.getPropertyValue("--" + name).trim();
  return { ink: of("ink"), paper: of("paper"), faint: of("faint"), line: of("line"), soft: of("soft"), link: of("link"), warn: of("warn"),
    font: getComputedStyle(document.body).fontFamily };
}

/// Short words for what pictures here are made of.
export function pen(to: CanvasRenderingContext2D, inks: Inks) {
  to.font = `11px ${inks.font}`;
  to.textBaseline = "middle";
  return {
    box(color: string, x: number, y: number, width: number, height: number) {
      to.fillStyle = color;
      to.fillRect(x, y, width, height);
    },
    say(text: string, x: number, y: number, align: CanvasTextAlign = "center", color = inks.faint) {
      to.fillStyle = color;
      to.textAlign = align;
      to.fillText(text, x, y);
    },
    line(color: string, points: [number, number][]) {
      to.beginPath();
      for (const [x, y] of points) to.lineTo(x, y);
      to.strokeStyle = color;
      to.lineWidth = 1.5;
      to.stroke();
    },
  };
}

interface CanvasProps {
  /// What it shows, for who cannot see it.
  label: string;
  /// Height in CSS pixels for a width.
  height: (width: number) => number;
  /// Draws in CSS pixels; called when it changes, and on each change of size and theme.
  draw: (context: CanvasRenderingContext2D, width: number, height: number, inks: Inks) => void;
  /// Handlers and attributes of the element.
  attributes?: Record<string, unknown>;
  element?: (canvas: HTMLCanvasElement) => void;
}

/// A canvas as wide as its place, in the screen's own pixels.
export class Canvas extends Component<CanvasProps, {}> {
  private canvas: HTMLCanvasElement | null = null;
  private seen: ResizeObserver | null = null;
  componentDidMount() {
    this.seen = new ResizeObserver(() => this.paint());
    if (this.canvas?.parentElement) this.seen.observe(this.canvas.parentElement);
    document.addEventListener("theme", this.paint);
    this.paint();
  }
  componentWillUnmount() {
    this.seen?.disconnect();
    document.removeEventListener("theme", this.paint);
  }
  componentDidUpdate() { this.paint(); }

  paint = () => {
    const canvas = this.canvas;
    const width = Math.floor(canvas?.parentElement?.clientWidth ?? 0);
    if (!canvas || width === 0) return;
    const height = Math.round(this.props.height(width));
    const scale = devicePixelRatio || 1;
    if (canvas.width !== Math.round(width * scale) || canvas.height !== Math.round(height * scale)) {
      canvas.width = Math.round(width * scale);
      canvas.height = Math.round(height * scale);
      canvas.style.width = width + "px";
      canvas.style.height = height + "px";
    }
    const context = canvas.getContext("2d")!;
    context.setTransform(scale, 0, 0, scale, 0, 0);
    context.clearRect(0, 0, width, height);
    this.props.draw(context, width, height, inks());
  };

  render() {
    const { label, attributes, element } = this.props;
    return <div class="canvas"><canvas role="img" aria-label={label} {...attributes}
      ref={(e?: Element) => { if (e) { this.canvas = e as HTMLCanvasElement; element?.(this.canvas); } }} /></div>;
  }
}

/// A figure's colour from pale yellow (0) to dark violet (1), as the figures have it: viridis, read
/// from five of its colours.
const kViridis = [[253, 231, 37], [94, 201, 98], [33, 145, 140], [59, 82, 139], [68, 1, 84]];
export function viridis(part: number): string {
  const at = Math.max(0, Math.min(1, part)) * (kViridis.length - 1);
  const i = Math.min(kViridis.length - 2, Math.floor(at));
  const mix = (k: number) => Math.round(kViridis[i][k] + (at - i) * (kViridis[i + 1][k] - kViridis[i][k]));
  return `rgb(${mix(0)},${mix(1)},${mix(2)})`;
}

/// Okabe and Ito's colours, those first that are well seen on white.
export const kColors = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#f0e442"];
