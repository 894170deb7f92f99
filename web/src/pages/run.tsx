// The run player: "#/c1/runs/e81200007?t=42&beside=c812-7,r7". Up to four runs on one clock.

import { Component, h } from "preact";
import { ApiError, get } from "../api";
import { draw_place, draw_run, draw_scores, pose_at, robot_at, robots_in_states, shape_of, Tint, Trajectory, value_at } from "../arena";
import { number, words } from "../format";
import { href, set_query } from "../route";
import { MachineDrawing } from "../machine";

const kMostRuns = 4;
const kSpeeds = [0.25, 0.5, 1, 2, 5, 10, 30];
const kUsualSpeed = 5;
const kTrails: [string, number][] = [["none", 0], ["10 s", 100], ["30 s", 300], ["all", 1e9]];
const kTints: [string, Tint][] = [["state", "state"], ["robot", "robot"], ["LEDs", "leds"]];

interface Props { c: string; id: string; query: Record<string, string> }
interface State {
  /// By id: the run, or why there is none.
  runs: Record<string, Trajectory | ApiError>;
  playing: boolean;
  cycle: number;         ///< as the texts say it; the canvas is drawn each frame
  chosen: number | null; ///< robot
  said: string;          ///< for who cannot see the canvas
  wanted: string;        ///< id in the field
}

function is_run(run: Trajectory | ApiError | undefined): run is Trajectory {
  return run !== undefined && !(run instanceof Error);
}

function seconds(cycle: number): string {
  return `${(Math.round(cycle) / 10).toFixed(1)}\u2009s`;
}

/// What acts in a state, or how the robot was seen.
function doing(run: Trajectory, robot: number, cycle: number): string {
  const state = value_at(run.robots[robot].state, cycle);
  return state === null ? "" : words(run.behaviours[state] ?? `state ${state}`);
}

export class RunPage extends Component<Props, State> {
  state: State = { runs: {}, playing: false, cycle: 0, chosen: null, said: "", wanted: "" };
  private cycle = 0;
  private last_frame = 0;
  private last_text = 0;
  private frame = 0;
  private has_begun = false;
  private canvases = new Map<string, HTMLCanvasElement>();
  private places = new Map<string, HTMLCanvasElement>();  ///< what does not move, drawn once a size
  private images = new Map<string, HTMLImageElement>();
  private strip: HTMLCanvasElement | null = null;
  private resizes = new ResizeObserver(() => { this.places.clear(); this.draw(); });
  private dark = matchMedia("(prefers-color-scheme: dark)");
  private themes = new MutationObserver(() => this.draw());

  componentDidMount(): void {
    addEventListener("keydown", this.on_key);
    this.dark.addEventListener("change", this.draw);
    this.themes.observe(document.documentElement, { attributes: true });
    this.cycle = this.asked_cycle(this.props) ?? 0;
    this.load();
  }

  componentWillUnmount(): void {
    removeEventListener("keydown", this.on_key);
    this.dark.removeEventListener("change", this.draw);
    this.themes.disconnect();
    this.resizes.disconnect();
    cancelAnimationFrame(this.frame);
  }

  componentWillReceiveProps(next: Props): void {
    if (next.id !== this.props.id || next.c !== this.props.c) {
      this.has_begun = false;
      this.cycle = 0;
      this.setState({ playing: false, chosen: null });
    }
    const asked = this.asked_cycle(next);
    if (!this.state.playing && asked !== null && Math.round(asked) !== Math.round(this.cycle)) this.cycle = asked;
  }

  componentDidUpdate(): void {
    this.load();
    this.draw();
  }

  private asked_cycle(props: Props): number | null {
    const t = Number(props.query.t);
    return props.query.t !== undefined && isFinite(t) && t >= 0 ? 10 * t : null;
  }

  private ids(): string[] {
    const beside = (this.props.query.beside ?? "").split(",").filter((id) => id !== "");
    return [...new Set([this.props.id, ...beside])].slice(0, kMostRuns);
  }

  /// The runs that are there, in order.
  private shown(): Trajectory[] {
    return this.ids().map((id) => this.state.runs[id]).filter(is_run);
  }

  private end(): number {
    return Math.max(1, ...this.shown().map((run) => run.cycles));
  }

  private speed(): number {
    const speed = Number(this.props.query.speed);
    return kSpeeds.includes(speed) ? speed : kUsualSpeed;
  }

  private trail(): number {
    return kTrails.find(([name]) => name === this.props.query.trail)?.[1] ?? 100;
  }

  private tint(): Tint {
    const tint = kTints.find(([, value]) => value === this.props.query.colour)?.[1] ?? "state";
    const has_states = this.shown().some((run) => run.robots.some((robot) => robot.state.length > 0));
    return tint === "state" && !has_states ? "robot" : tint;
  }

  private asking = new Set<string>();

  private load(): void {
    for (const id of this.ids()) {
      if (this.state.runs[id] || this.asking.has(id)) continue;
      this.asking.add(id);
      const keep = (run: Trajectory | ApiError) => {
        this.asking.delete(id);
        this.setState(({ runs }) => ({ runs: { ...runs, [id]: run } }), () => this.begin());
      };
      get<Trajectory>(`${this.props.c}/runs/${id}/trajectory`).then(keep, keep);
    }
  }

  /// Plays, once the run is there, unless the address says when, or the reader wants it calm.
  private begin(): void {
    if (this.has_begun || !is_run(this.state.runs[this.props.id])) return;
    this.has_begun = true;
    const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
    if (this.asked_cycle(this.props) === null && !calm) this.play(); else this.seek(this.cycle);
  }

  // --- the clock ----------------------------------------------------------------------------------

  private play = (): void => {
    if (this.cycle >= this.end()) this.cycle = 0;
    this.last_frame = 0;
    this.setState({ playing: true });
    cancelAnimationFrame(this.frame);
    this.frame = requestAnimationFrame(this.tick);
  };

  private pause = (): void => {
    cancelAnimationFrame(this.frame);
    this.setState({ playing: false });
    this.seek(Math.round(this.cycle));
  };

  private toggle = (): void => (this.state.playing ? this.pause() : this.play());

  private tick = (now: number): void => {
    const past_s = this.last_frame ? Math.min(0.25, (now - this.last_frame) / 1000) : 0;
    this.last_frame = now;
    this.cycle = Math.min(this.end(), this.cycle + 10 * past_s * this.speed());
    if (this.cycle >= this.end()) return this.pause();
    this.draw();
    if (now - this.last_text > 90) {
      this.last_text = now;
      this.setState({ cycle: Math.round(this.cycle) });
    }
    this.frame = requestAnimationFrame(this.tick);
  };

  /// To an instant, which the address then names.
  private seek = (cycle: number): void => {
    this.cycle = Math.min(this.end(), Math.max(0, Math.round(cycle)));
    this.setState({ cycle: this.cycle, said: this.sentence() });
    this.draw();
    if (!this.state.playing) set_query({ t: String(this.cycle / 10) });
  };

  private sentence(): string {
    const parts = this.shown().map((run) => {
      const robots = run.robots.map((_, robot) => `robot ${robot} ${doing(run, robot, this.cycle)}`).join(", ");
      return `${run.id}: score ${number(this.score(run))}; ${robots}`;
    });
    return `${seconds(this.cycle)}. ${parts.join(". ")}`;
  }

  private score(run: Trajectory): number | null {
    return run.score_at[Math.min(Math.round(this.cycle), run.score_at.length - 1)] ?? null;
  }

  private on_key = (event: KeyboardEvent): void => {
    const target = event.target as HTMLElement;
    const types = target.tagName === "TEXTAREA" || target.tagName === "INPUT" && (target as HTMLInputElement).type !== "range";
    if (types || event.ctrlKey || event.altKey || event.metaKey) return;
    const speeds = (by: number) =>
      set_query({ speed: kSpeeds[Math.max(0, Math.min(kSpeeds.length - 1, kSpeeds.indexOf(this.speed()) + by))] });
    const actions: Record<string, () => void> = {
      ArrowLeft: () => this.seek(this.cycle - 10), ArrowRight: () => this.seek(this.cycle + 10),
      ",": () => this.step(-1), ".": () => this.step(1), "[": () => speeds(-1), "]": () => speeds(1),
      Home: () => this.seek(0), End: () => this.seek(this.end()), " ": this.toggle,
    };
    // A button or a link in focus has the space bar for itself, and a list its arrows.
    if (event.key === " " && /^(BUTTON|A|SELECT|SUMMARY)$/.test(target.tagName)) return;
    if (target.tagName === "SELECT" || !actions[event.key]) return;
    event.preventDefault();
    actions[event.key]();
  };

  private step(by: number): void {
    if (this.state.playing) this.pause();
    this.seek(Math.round(this.cycle) + by);
  }

  // --- drawing ------------------------------------------------------------------------------------

  private draw = (): void => {
    const style = getComputedStyle(document.documentElement);
    const ink = style.getPropertyValue("--ink").trim() || "#000";
    const faint = style.getPropertyValue("--faint").trim() || "#888";
    const view = { cycle: this.cycle, trail_cycles: this.trail(), tint: this.tint(), chosen: this.state.chosen };
    for (const run of this.shown()) {
      const canvas = this.canvases.get(run.id);
      if (!canvas || !fit(canvas, shape_of(run.arena))) continue;
      const pen = canvas.getContext("2d")!;
      pen.setTransform(1, 0, 0, 1, 0, 0);
      pen.clearRect(0, 0, canvas.width, canvas.height);
      pen.drawImage(this.place(run, canvas), 0, 0);
      pen.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
      draw_run(pen, run, view, canvas.clientWidth, canvas.clientHeight);
    }
    if (this.strip && fit(this.strip)) {
      const pen = this.strip.getContext("2d")!;
      pen.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
      pen.clearRect(0, 0, this.strip.clientWidth, this.strip.clientHeight);
      draw_scores(pen, this.shown(), this.cycle, this.strip.clientWidth, this.strip.clientHeight, ink, faint);
    }
  };

  private place(run: Trajectory, canvas: HTMLCanvasElement): HTMLCanvasElement {
    const kept = this.places.get(run.id);
    if (kept && kept.width === canvas.width && kept.height === canvas.height) return kept;
    for (const { image } of run.arena.patches) {
      if (!image || this.images.has(image)) continue;
      const picture = new Image();
      picture.onload = () => { this.places.clear(); this.draw(); };
      picture.src = image;
      this.images.set(image, picture);
    }
    const place = document.createElement("canvas");
    place.width = canvas.width;
    place.height = canvas.height;
    const pen = place.getContext("2d")!;
    pen.scale(devicePixelRatio, devicePixelRatio);
    draw_place(pen, run.arena, canvas.clientWidth, canvas.clientHeight, this.images);
    this.places.set(run.id, place);
    return place;
  }

  private choose = (run: Trajectory, event: MouseEvent): void => {
    const canvas = event.currentTarget as HTMLCanvasElement;
    const box = canvas.getBoundingClientRect();
    const found = robot_at(run, this.cycle, box.width, box.height, event.clientX - box.left, event.clientY - box.top);
    this.setState({ chosen: found === this.state.chosen ? null : found });
  };

  private keep = (id: string) => (element?: Element): void => {
    const before = this.canvases.get(id);
    if (before && before !== element) this.resizes.unobserve(before);
    if (!element) { this.canvases.delete(id); return; }
    if (before !== element) this.resizes.observe(element);
    this.canvases.set(id, element as HTMLCanvasElement);
  };

  // --- beside -------------------------------------------------------------------------------------

  private put_beside = (id: string): void => {
    if (id === "") return;
    set_query({ beside: [...this.ids().slice(1), id].join(",") }, true);
    this.setState({ wanted: "" });
  };

  private take_away = (id: string): void => {
    set_query({ beside: this.ids().slice(1).filter((other) => other !== id).join(",") }, true);
  };

  render() {
    const { c, id } = this.props;
    const run = this.state.runs[id];
    const ids = this.ids();
    return <div class="run-page">
      <h1>Run {id}{is_run(run) ? <span class="sub"> {words(run.mission)}{run.design ? <span>, design <a href={href([c, run.design])}>{run.design}</a></span> : null}</span> : null}</h1>
      {this.controls()}
      <div class={`run-panels of-${ids.length}`}>{ids.map((one) => this.panel(one))}</div>
      <p class="unseen" aria-live="polite">{this.state.playing ? "" : this.state.said}</p>
      {this.beside(ids)}
      {is_run(run) ? this.elsewhere(run) : null}
    </div>;
  }

  private controls() {
    const { playing, cycle } = this.state;
    const end = this.end();
    const choice = (label: string, name: string, value: string, options: [string, string][]) =>
      <label class="choice">{label} <select value={value} onChange={(event: Event) => set_query({ [name]: (event.target as HTMLSelectElement).value })}>
        {options.map(([text, word]) => <option value={word} selected={word === value}>{text}</option>)}
      </select></label>;
    return <section class="run-controls" aria-label="Player">
      <div class="run-buttons">
        <button class="play" onClick={this.toggle} aria-keyshortcuts="Space">{playing ? "Pause" : "Play"}</button>
        <button onClick={() => this.seek(0)} aria-label="To the start" aria-keyshortcuts="Home">|◀</button>
        <button onClick={() => this.step(-1)} aria-label="One cycle back" aria-keyshortcuts=",">◀</button>
        <button onClick={() => this.step(1)} aria-label="One cycle on" aria-keyshortcuts=".">▶</button>
        <output class="run-time">{seconds(cycle)} of {seconds(end)}</output>
        {choice("Speed", "speed", String(this.speed()), kSpeeds.map((speed) => [`${speed}×`, String(speed)]))}
        {choice("Trails", "trail", kTrails.find(([, value]) => value === this.trail())![0], kTrails.map(([name]) => [name, name]))}
        {choice("Colour by", "colour", this.tint(), kTints)}
      </div>
      <input type="range" class="run-slider" aria-label="Time" aria-valuetext={seconds(cycle)} min={0} max={end} step={1} value={String(cycle)}
        onInput={(event: Event) => this.seek(Number((event.target as HTMLInputElement).value))} />
      <canvas class="run-strip" role="img" aria-label={`Score so far, higher is better: ${this.shown().map((one) => `${one.id} ${number(this.score(one))}`).join(", ")}`}
        ref={(element?: Element) => { this.strip = (element as HTMLCanvasElement) ?? null; }}
        onClick={(event: MouseEvent) => this.seek(this.end() * event.offsetX / (event.target as HTMLElement).clientWidth)} />
      <p class="hint">Score so far above its time (higher is better). Keys: space plays, ← → one second, <kbd>,</kbd> <kbd>.</kbd> one cycle, <kbd>[</kbd> <kbd>]</kbd> speed, Home, End.</p>
    </section>;
  }

  private panel(id: string) {
    const run = this.state.runs[id];
    const is_first = id === this.props.id;
    const away = is_first ? null : <button class="away" aria-label={`Take ${id} away`} onClick={() => this.take_away(id)}>×</button>;
    if (run === undefined) return <section key={id} class="card run-panel" aria-label={id}><h2>{id}{away}</h2><p>Simulating…</p></section>;
    if (!is_run(run)) return <section key={id} class="card run-panel" aria-label={id}><h2>{id}{away}</h2><p class="error" role="alert">{run.message}</p></section>;
    return <section key={id} class="card run-panel" aria-label={`Run ${id}`}>
      <h2>{this.heading(run)}{away}</h2>
      <canvas class="arena" role="img" aria-label={`Arena of ${words(run.mission)} from above with ${run.robots.length} robots at ${seconds(this.state.cycle)}`}
        ref={this.keep(id)} onClick={(event: MouseEvent) => this.choose(run, event)} />
      <dl class="run-facts">
        <dt>score so far</dt><dd class="score">{number(this.score(run))}</dd>
        <dt>at the end</dt><dd>{number(run.score)}</dd>
        <dt>bits</dt><dd>{this.bits(run)}</dd>
      </dl>
      {this.robots(run)}
      {run.candidate && run.robots.some((robot) => robot.state.length > 0)
        ? <MachineDrawing c={this.props.c} candidate={run.candidate} lit={robots_in_states(run, this.state.cycle)} chosen={this.state.chosen} /> : null}
    </section>;
  }

  private heading(run: Trajectory) {
    const { c } = this.props;
    const candidate = run.candidate ? <a href={href([c, run.candidate])}>{run.candidate}</a> : "no candidate";
    return <span>{run.id.startsWith("r") ? <span>{run.id}{run.name ? ` ${run.name}` : ""}, </span> : null}{candidate}{run.seed === null ? null : `, seed ${run.seed}`}, {run.source}</span>;
  }

  private bits(run: Trajectory) {
    if (run.verdict !== undefined && run.verdict !== null) return <span>filmed; verdict: {run.verdict}</span>;
    if (run.same_bits === null) return <span>the store holds no such run to compare with</span>;
    return run.same_bits ? <span class="good" title={`state digest ${run.digest}`}>✓ same bits as stored</span>
      : <span class="bad">differs from the stored run: {number(run.stored_score)}, made by another engine</span>;
  }

  private robots(run: Trajectory) {
    const has_kinds = run.robots.some((robot) => robot.kind?.length);
    const { cycle, chosen } = this.state;
    return <details class="run-robots" open={run.robots.length <= 5}>
      <summary>{run.robots.length} robots at {seconds(cycle)}</summary>
      <table><thead><tr><th scope="col">robot</th><th scope="col">does</th>{has_kinds ? <th scope="col">pose is</th> : null}
        <th scope="col" class="num">x, m</th><th scope="col" class="num">y, m</th></tr></thead>
        <tbody>{run.robots.map((robot, at) => {
          const pose = pose_at(robot, cycle);
          return <tr class={chosen === at ? "chosen" : ""}>
            <th scope="row"><button class="link" aria-pressed={String(chosen === at)} onClick={() => this.setState({ chosen: chosen === at ? null : at })}>
              {at}{robot.name ? ` ${robot.name}` : ""}</button></th>
            <td>{doing(run, at, cycle) || "–"}</td>{has_kinds ? <td>{value_at(robot.kind, cycle) ?? "–"}</td> : null}
            <td class="num">{pose ? pose.x.toFixed(2) : "–"}</td><td class="num">{pose ? pose.y.toFixed(2) : "–"}</td></tr>;
        })}</tbody></table>
    </details>;
  }

  private beside(ids: string[]) {
    const run = this.state.runs[this.props.id];
    if (!is_run(run) || ids.length >= kMostRuns) return null;
    return <section class="card run-beside" aria-label="Beside">
      <h2>Put another run beside it</h2>
      <form onSubmit={(event: Event) => { event.preventDefault(); this.put_beside(this.state.wanted.trim()); }}>
        <label>An evaluation (e81200007), a candidate and a seed (c812-{run.seed ?? 7}), or a real run (r7){" "}
          <input name="beside" value={this.state.wanted} autocomplete="off" spellcheck={false} size={14}
            onInput={(event: Event) => this.setState({ wanted: (event.target as HTMLInputElement).value })} /></label>
        <button type="submit">Put beside</button>
      </form>
    </section>;
  }

  private elsewhere(run: Trajectory) {
    return <p class="hint">The same as a table: <a href={`api/v1/${this.props.c}/runs/${run.id}/trajectory.csv`} download>{run.id}.csv</a>.</p>;
  }
}

/// Sets a canvas' pixels to its size on the page; false while it has none.
function fit(canvas: HTMLCanvasElement, shape = 0): boolean {
  if (shape) canvas.style.height = `${Math.round(canvas.clientWidth * shape)}px`;
  const [width, height] = [Math.round(canvas.clientWidth * devicePixelRatio), Math.round(canvas.clientHeight * devicePixelRatio)];
  if (!width || !height) return false;
  if (canvas.width !== width || canvas.height !== height) { canvas.width = width; canvas.height = height; }
  return true;
}
