// The run player: "#/c1/runs/e81200007?t=42&beside=c812-7,r7". Up to four runs on one clock.

import { Component, h } from "preact";
import { ApiError, ask, feed } from "../api";
import { draw_place, draw_run, draw_scores, kDistinct, pose_at, robot_at, shape_of, Tint, Trajectory, value_at } from "../arena";
import { Canvas, Inks } from "../canvas";
import { Choice, Copy, Fact, Failure, Panel, Waiting } from "../components";
import { Figure } from "../figure";
import { number, shell_word, words } from "../format";
import { Get } from "../get";
import { Page, PageProps } from "../page";
import { href, set_query } from "../route";
import { DesignAnswer } from "../types";

const kMostRuns = 4;
const kSpeeds = [0.25, 0.5, 1, 2, 5, 10, 30];
const kUsualSpeed = 5;
const kTrails: [string, number][] = [["none", 0], ["10 s", 100], ["30 s", 300], ["all", 1e9]];
const kProfiles = ["rvr", "argos3", "pseudo-reality"];
const kTints: [string, Tint][] = [["state", "state"], ["robot", "robot"], ["LEDs", "leds"]];

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

function metres(value: number): string {
  return value.toFixed(2).replace("-", "\u2212");
}

/// What acts in a robot.
function doing(run: Trajectory, robot: number, cycle: number): string {
  const state = value_at(run.robots[robot].state, cycle);
  return state === null ? "" : words(run.behaviours[state] ?? `state ${state}`);
}

/// Lights up the states of a drawn machine that act, with the robots that are in them.
function light(svg: SVGSVGElement, run: Trajectory, cycle: number, chosen: number | null): void {
  svg.querySelectorAll<SVGGElement>("g[data-state]").forEach((part) => {
    const state = Number(part.dataset.state);
    const here = run.robots.map((_, robot) => robot).filter((robot) => value_at(run.robots[robot].state, cycle) === state);
    const is_lit = chosen === null ? here.length > 0 : here.includes(chosen);
    part.classList.toggle("lit", is_lit);
    let text = part.querySelector<SVGTextElement>("text.here");
    if (!text) {
      const circle = part.querySelector("circle");
      if (!circle) return;
      text = document.createElementNS("http://www.w3.org/2000/svg", "text");
      text.classList.add("here");
      text.setAttribute("x", circle.getAttribute("cx")!);
      const [middle, radius] = [Number(circle.getAttribute("cy")), Number(circle.getAttribute("r"))];
      text.setAttribute("y", String(middle - radius > 4 ? middle - radius - 1 : middle + radius + 3));
      text.setAttribute("font-size", "2.6");
      text.setAttribute("text-anchor", "middle");
      part.append(text);
    }
    const said = here.length === 0 ? "" : here.length > 6 ? `${here.length} robots` : `robot ${here.join(", ")}`;
    if (text.textContent !== said) text.textContent = said;
  });
}

class RunPage extends Component<PageProps, State> {
  state: State = { runs: {}, playing: false, cycle: 0, chosen: null, said: "", wanted: "" };
  private cycle = 0;
  private last_frame = 0;
  private last_text = 0;
  private frame = 0;
  private has_begun = false;
  private canvases = new Map<string, Canvas>();
  private strip: Canvas | null = null;
  private places = new Map<string, HTMLCanvasElement>();  ///< what does not move, drawn once a size
  private images = new Map<string, HTMLImageElement>();
  private machines = new Map<string, SVGSVGElement>();    ///< by run
  private asking = new Set<string>();

  componentDidMount(): void {
    addEventListener("keydown", this.on_key);
    this.cycle = this.asked_cycle(this.props) ?? 0;
    this.load();
  }

  componentWillUnmount(): void {
    removeEventListener("keydown", this.on_key);
    cancelAnimationFrame(this.frame);
  }

  componentWillReceiveProps(next: PageProps): void {
    if (next.params.id !== this.props.params.id || next.params.c !== this.props.params.c) {
      cancelAnimationFrame(this.frame);
      this.has_begun = false;
      this.cycle = this.asked_cycle(next) ?? 0;
      this.setState({ playing: false, chosen: null, cycle: this.cycle });
      if (next.params.c !== this.props.params.c) this.setState({ runs: {} });
    }
    const asked = this.asked_cycle(next);
    if (!this.state.playing && asked !== null && Math.round(asked) !== Math.round(this.cycle)) {
      this.cycle = asked;
      this.setState({ cycle: asked });
    }
  }

  componentDidUpdate(): void {
    this.load();
    this.draw();
    for (const run of this.shown()) {
      const svg = this.machines.get(run.id);
      if (svg) light(svg, run, this.state.cycle, this.state.chosen);
    }
  }

  private asked_cycle(props: PageProps): number | null {
    const t = Number(props.query.t);
    return props.query.t !== undefined && isFinite(t) && t >= 0 ? 10 * t : null;
  }

  private ids(): string[] {
    const beside = (this.props.query.beside ?? "").split(",").filter((id) => id !== "");
    return [...new Set([this.props.params.id, ...beside])].slice(0, kMostRuns);
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

  private load(): void {
    for (const id of this.ids()) {
      if (this.state.runs[id] || this.asking.has(id)) continue;
      this.asking.add(id);
      const keep = (run: Trajectory | ApiError) => {
        this.asking.delete(id);
        this.setState({ runs: { ...this.state.runs, [id]: run } }, () => this.begin());
      };
      ask(`${this.props.params.c}/runs/${id}/trajectory`).then(({ data }) => keep(data as Trajectory), keep);
    }
  }

  /// Plays, once the run is there, unless the address says when, or the reader wants it calm.
  private begin(): void {
    if (this.has_begun || !is_run(this.state.runs[this.props.params.id])) return;
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
    this.canvases.forEach((canvas) => canvas.paint());
    this.strip?.paint();
  };

  private draw_arena(run: Trajectory, pen: CanvasRenderingContext2D, width: number, height: number): void {
    pen.drawImage(this.place(run, width, height), 0, 0, width, height);
    draw_run(pen, run, { cycle: this.cycle, trail_cycles: this.trail(), tint: this.tint(), chosen: this.state.chosen }, width, height);
  }

  private place(run: Trajectory, width: number, height: number): HTMLCanvasElement {
    const scale = devicePixelRatio || 1;
    const kept = this.places.get(run.id);
    if (kept && kept.width === Math.round(width * scale)) return kept;
    for (const { image } of run.arena.patches) {
      if (!image || this.images.has(image)) continue;
      const picture = new Image();
      picture.onload = () => { this.places.clear(); this.draw(); };
      picture.src = image;
      this.images.set(image, picture);
    }
    const place = document.createElement("canvas");
    place.width = Math.round(width * scale);
    place.height = Math.round(height * scale);
    const pen = place.getContext("2d")!;
    pen.scale(scale, scale);
    draw_place(pen, run.arena, width, height, this.images);
    this.places.set(run.id, place);
    return place;
  }

  private choose(run: Trajectory, event: MouseEvent): void {
    const box = (event.currentTarget as HTMLCanvasElement).getBoundingClientRect();
    const found = robot_at(run, this.cycle, box.width, box.height, event.clientX - box.left, event.clientY - box.top);
    this.setState({ chosen: found === this.state.chosen ? null : found });
  }

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
    const { params: { c, id } } = this.props;
    const run = this.state.runs[id];
    const ids = this.ids();
    return <div>
      <h1>Run {id} {is_run(run) && <span class="sub">{words(run.mission)}{run.design && <span>, design <a href={href([c, run.design])}>{run.design}</a></span>}</span>}</h1>
      {this.controls()}
      <div class={ids.length === 1 ? "runs alone" : "runs"}>{ids.map((one) => this.panel(one))}</div>
      <p class="unseen" role="status">{this.state.playing ? "" : this.state.said}</p>
      {is_run(run) && <div class="grid">{ids.length < kMostRuns && this.beside(run)}{this.elsewhere(run)}</div>}
    </div>;
  }

  private controls() {
    const { playing, cycle } = this.state;
    const end = this.end();
    return <section class="panel player" aria-label="player">
      <div class="tools">
        <button class="main play" onClick={this.toggle} aria-keyshortcuts="Space">{playing ? "Pause" : "Play"}</button>
        <button onClick={() => this.seek(0)} aria-label="to the start" aria-keyshortcuts="Home">«</button>
        <button onClick={() => this.step(-1)} aria-label="one cycle back" aria-keyshortcuts=",">‹</button>
        <button onClick={() => this.step(1)} aria-label="one cycle on" aria-keyshortcuts=".">›</button>
        <output class="time">{seconds(cycle)} <span class="faint">of {seconds(end)}</span></output>
        <span class="push" />
        <Choice label="Speed" name="speed" value={String(this.speed())} options={kSpeeds.map((speed) => [`${speed}×`, String(speed)])} />
        <Choice label="Trails" name="trail" value={kTrails.find(([, value]) => value === this.trail())![0]} options={kTrails.map(([name]) => [name, name])} />
        <Choice label="Colour by" name="colour" value={this.tint()} options={kTints} />
      </div>
      <input type="range" aria-label="time" aria-valuetext={seconds(cycle)} min={0} max={end} step={1} value={String(cycle)}
        onInput={(event) => this.seek(Number((event.target as HTMLInputElement).value))} />
      <Canvas ref={(it: any) => { this.strip = it; }} height={() => 46}
        label={`Score so far, higher is better: ${this.shown().map((one) => `${one.id} ${number(this.score(one))}`).join(", ")}`}
        draw={(pen, width, height, inks: Inks) => draw_scores(pen, this.shown(), this.cycle, width, height, inks)}
        attributes={{ onClick: (event: MouseEvent) => this.seek(end * event.offsetX / (event.target as HTMLElement).clientWidth) }} />
      <p class="faint small">Below the slider: the score so far (higher is better). Space plays, <kbd>←</kbd> <kbd>→</kbd> one second, <kbd>,</kbd> <kbd>.</kbd> one cycle, <kbd>[</kbd> <kbd>]</kbd> speed. Click a robot to follow it.</p>
    </section>;
  }

  private panel(id: string) {
    const run = this.state.runs[id];
    const away = id !== this.props.params.id
      && <button class="quiet" aria-label={`take ${id} away`} onClick={() => this.take_away(id)}>✕</button>;
    const head = (title: any) => <div class="panel-head"><h2>{title}</h2>{away}</div>;
    if (run === undefined) return <section key={id} class="panel" aria-label={id}>{head(id)}<Waiting /></section>;
    if (!is_run(run)) return <section key={id} class="panel" aria-label={id}>{head(id)}<Failure error={run} /></section>;
    const has_machine = run.candidate && run.robots.some((robot) => robot.state.length > 0);
    return <section key={id} class="panel run" data-run={id} aria-label={`run ${id}`}>
      {head(this.heading(run))}
      <Canvas ref={(it: any) => { if (it) this.canvases.set(id, it); else this.canvases.delete(id); }}
        label={`${words(run.mission)} from above, ${run.robots.length} robots, at ${seconds(this.state.cycle)}`}
        height={(width) => Math.min(width * shape_of(run.arena), 640)}
        draw={(pen, width, height) => this.draw_arena(run, pen, width, height)}
        attributes={{ onClick: (event: MouseEvent) => this.choose(run, event) }} />
      <dl class="facts">
        <Fact name="score so far"><span data-what="score">{number(this.score(run))}</span></Fact>
        <Fact name="at the end">{number(run.score)}</Fact>
        <Fact name={run.verdict ? "verdict" : "simulated again"}>{this.bits(run)}</Fact>
      </dl>
      {this.robots(run)}
      {has_machine && <Figure c={this.props.params.c} kind="machine" options={{ candidate: run.candidate }} name={`control software of ${run.candidate}`}
        placed={(svg) => { this.machines.set(id, svg); light(svg, run, this.state.cycle, this.state.chosen); }} />}
    </section>;
  }

  private heading(run: Trajectory) {
    const { c } = this.props.params;
    return <span>{run.verdict && <span>{run.id} {run.name ?? ""}, </span>}{run.candidate && <a href={href([c, run.candidate])}>{run.candidate}</a>}
      {run.seed !== null && `, seed ${run.seed}`}, {run.source}</span>;
  }

  private bits(run: Trajectory) {
    if (run.verdict) return <span>{run.verdict}</span>;
    if (run.same_bits === null) return <span class="faint small">nothing stored to compare with</span>;
    return run.same_bits ? <span class="good" title={`state digest ${run.digest}`}>✓ same bits</span>
      : <span class="warn">differs: the store has {number(run.stored_score)}</span>;
  }

  private robots(run: Trajectory) {
    const { cycle, chosen } = this.state;
    const has_kinds = run.robots.some((robot) => robot.kind?.length);
    const tint = this.tint();
    return <details open={run.robots.length <= 6}>
      <summary>{run.robots.length} robots at {seconds(cycle)}</summary>
      <div class="scroll"><table class="robots"><caption class="unseen">robots of {run.id}</caption><thead><tr><th scope="col">robot</th><th scope="col">does</th>{has_kinds && <th scope="col">pose is</th>}
        <th scope="col" class="n">x, m</th><th scope="col" class="n">y, m</th></tr></thead>
        <tbody>{run.robots.map((robot, at) => {
          const pose = pose_at(robot, cycle);
          const state = tint === "state" ? value_at(robot.state, cycle) : at;
          return <tr class={chosen === at ? "chosen" : ""}>
            <th scope="row"><button class="quiet" aria-pressed={chosen === at ? "true" : "false"}
              onClick={() => this.setState({ chosen: chosen === at ? null : at })}>
              <svg class="dot" viewBox="0 0 10 10" aria-hidden="true"><circle cx="5" cy="5" r="4.5" fill={kDistinct[(state ?? at) % kDistinct.length]} /></svg>
              {at}{robot.name ? ` ${robot.name}` : ""}</button></th>
            <td>{doing(run, at, cycle) || "–"}</td>{has_kinds && <td>{value_at(robot.kind, cycle) ?? "–"}</td>}
            <td class="n">{pose ? metres(pose.x) : "–"}</td><td class="n">{pose ? metres(pose.y) : "–"}</td></tr>;
        })}</tbody></table></div>
    </details>;
  }

  private beside(run: Trajectory) {
    const { c } = this.props.params;
    const seed = run.seed ?? 1;
    const shown = this.ids();
    const offer = (name: string, runs: [string, string][]) => {
      const open = runs.filter(([id]) => !shown.includes(id));
      return open.length > 0 && <p class="tools"><span class="faint">{name}</span>
        {open.map(([id, text]) => <button onClick={() => this.put_beside(id)}>{text}</button>)}</p>;
    };
    return <Panel title="Put another run beside it">
      {run.verdict && run.candidate && offer("Simulated from the same starts:", [1, 2, 3].map((n) => [`${run.id}-${n}`, `seed ${n}`]))}
      {!run.verdict && offer("The same under:", kProfiles.filter((name) => name !== run.source).map((name) => [`${run.candidate}-${seed}@${name}`, name]))}
      {run.design && !run.verdict && <Get<DesignAnswer> path={`${c}/designs/${run.design}`} render={({ elites }) => {
        const last = Math.max(0, ...elites.map(({ iteration }) => iteration));
        return offer("On the same seed, elites:", elites.filter(({ iteration }) => iteration === last).map(({ candidate }): [string, string] => [`c${candidate}-${seed}`, `c${candidate}`])
          .filter(([, name]) => name !== run.candidate).slice(0, 4)) || null;
      }} />}
      <form class="tools" onSubmit={(event) => { event.preventDefault(); this.put_beside(this.state.wanted.trim()); }}>
        <label>Run <input name="beside" value={this.state.wanted} autocomplete="off" size={14}
          onInput={(event) => this.setState({ wanted: (event.target as HTMLInputElement).value })} /></label>
        <button type="submit">Put beside</button>
      </form>
      <p class="faint small">An evaluation (e81200007), a candidate and a seed (c812-{seed}), or a real run (r7). All run on one clock.</p>
    </Panel>;
  }

  private elsewhere(run: Trajectory) {
    const { c } = this.props.params;
    const store = feed.live?.campaigns.find((one) => one.c === c)?.store ?? "STORE";
    const which = run.id.includes("-") ? `${run.candidate} ${shell_word(store)} --seed ${run.seed}` : `${run.id} ${shell_word(store)}`;
    const command = `swarmsmith replay ${which} --csv run.csv`;
    return <Panel title="Elsewhere">
      <p><a href={`api/v1/${c}/runs/${run.id}/trajectory.csv`} download={`${run.id}.csv`}>All poses as CSV</a></p>
      <p><code>{command}</code> <Copy text={command} what="Copy as command" /></p>
    </Panel>;
  }
}

export const run: Page = { pattern: ":c/runs/:id", title: ({ id }) => `run ${id}`, view: RunPage,
  keys: [{ key: "space", what: "play or pause" }, { key: "← →", what: "one second back or on" }, { key: ", .", what: "one cycle back or on" },
    { key: "[ ]", what: "slower or faster" }, { key: "Home End", what: "to the start or the end" }] };
