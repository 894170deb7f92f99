// The run player: "#/c1/runs/e81200007?t=42&beside=c812-7,r7". Up to four runs with one clock.

import { Component, h } from "preact";
import { ApiError, ask } from "../api";
import { Check, draw_place, draw_run, draw_scores, kDistinct, pose_at, Robot, robot_at, shape_of, Tint, Trajectory, value_at } from "../arena";
import { Canvas } from "../canvas";
import { Choice, Copy, Empty, Failure, is_typing, link, pairs, Panel, Quiet, Slider, store_word, Table, typed, Waiting } from "../components";
import { Machine } from "../figure";
import { clamp, number, words } from "../format";
import { Get } from "../get";
import { PageProps } from "../page";
import { set_query } from "../route";
import { DesignAnswer } from "../types";

const kMostRuns = 4;
const kSpeeds = [0.25, 0.5, 1, 2, 5, 10, 30];
const kUsualSpeed = 5;
/// Lengths in cycles.
const kTrails: Record<string, number> = { none: 0, "10 s": 100, "30 s": 300, all: 1e9 };
const kTints: [string, Tint][] = [["state", "state"], ["robot", "robot"], ["LEDs", "leds"]];

interface State {
  /// By id: the run, or the error.
  runs: Record<string, Trajectory | ApiError>;
  playing: boolean;
  cycle: number;         ///< for the texts; the canvas is drawn at each frame
  chosen: number | null; ///< robot
  said: string;          ///< for screen readers
  wanted: string;        ///< the id in the field
}

function is_run(run: Trajectory | ApiError | undefined): run is Trajectory { return !!run && "robots" in run; }

function has_states(run: Trajectory): boolean { return run.robots.some((one) => one.state.length); }

function seconds(cycle: number): string {
  return `${(Math.round(cycle) / 10).toFixed(1)}\u2009s`;
}

function metres(value: number | undefined): string {
  return value?.toFixed(2).replace("-", "\u2212") ?? "–";
}

/// The active module of a robot.
function doing({ behaviours }: Trajectory, robot: Robot, cycle: number): string {
  const state = value_at(robot.state, cycle);
  return state === null ? "" : words(behaviours[state] ?? `state ${state}`);
}

/// Highlights the active states of a drawn machine, with the numbers of the robots in them.
function light(svg: SVGSVGElement, run: Trajectory, cycle: number, chosen: number | null): void {
  const acting = run.robots.map((robot) => value_at(robot.state, cycle));
  svg.querySelectorAll<SVGGElement>("g[data-state]").forEach((part) => {
    const here = [...acting.keys()].filter((robot) => acting[robot] === Number(part.dataset.state));
    part.classList.toggle("lit", chosen === null ? here.length > 0 : here.includes(chosen));
    let text = part.querySelector(".here");
    const circle = part.querySelector("circle");
    if (!text && circle) {
      text = document.createElementNS("http://www.w3.org/2000/svg", "text");
      const [x, y, radius] = ["cx", "cy", "r"].map((name) => Number(circle.getAttribute(name)));
      const attributes = { class: "here", x, y: y - radius > 4 ? y - radius - 1 : y + radius + 3, "font-size": 2.6, "text-anchor": "middle" };
      for (const [name, value] of Object.entries(attributes)) text.setAttribute(name, String(value));
      part.append(text);
      const box = svg.viewBox.baseVal;  // a machine with a single row has no room below it
      box.height = Math.max(box.height, attributes.y + 1 - box.y);
    }
    if (text) text.textContent = here.length > 6 ? `${here.length} robots` : here.length ? `robot ${here.join(", ")}` : "";
  });
}

const kOutcomes = ["failed", "warned", "not run", "passed"];

/// "; not checked: length of the film": each name once.
function not_checked(checks: Check[] | null | undefined) {
  const names = [...new Set((checks ?? []).filter((one) => one.outcome === "not run").map((one) => one.name))];
  return names.length > 0 && <small>; not checked: {names.join(", ")}</small>;
}

/// The checks of a real run; those that did not pass come first.
function Checks({ checks }: { checks: Check[] | null }) {
  const measure = ({ unit }: Check, value: number | null) => value === null ? null : `${number(value)} ${unit}`.trim();
  const passed = checks?.filter((one) => one.outcome === "passed").length;
  const rows = [...checks ?? []].sort((a, b) => kOutcomes.indexOf(a.outcome) - kOutcomes.indexOf(b.outcome));
  return <Panel title="Checks of the verdict" wide>
    {checks ? <p><small>{passed} of {checks.length} passed. Each says which fault it can find.</small></p>
      : <Empty>Not recorded: an earlier version scored this run. Use <code>swarmsmith track rescore</code>.</Empty>}
    {checks && <Table<Check> name="k" caption="checks" rows={rows} page_size={50} row_key={(one) => one.name + one.subject} columns={[
      { key: "outcome", show: ({ outcome }) => outcome === "passed" ? outcome : <span class="warn">{outcome}</span> },
      { key: "name", label: "check" }, { key: "subject", label: "of", value: (one) => one.subject || null },
      { key: "value", label: "number", show: (one) => measure(one, one.value) }, { key: "limit", show: (one) => measure(one, one.limit) },
      { key: "catches", label: "it catches" }, { key: "reason", label: "why not", value: (one) => one.reason || null }]} />}
  </Panel>;
}

/// A new player is made for each run.
export function RunPage(props: PageProps) {
  return <Player key={`${props.params.c} ${props.params.id}`} {...props} />;
}

class Player extends Component<PageProps, State> {
  state: State = { runs: {}, playing: false, cycle: 0, chosen: null, said: "", wanted: "" };
  #cycle = 0;
  #last_frame = 0;
  #last_text = 0;
  #frame = 0;
  #has_begun = false;
  #canvases = new Map<string, Canvas>();
  #strip: Canvas | null = null;
  #images = new Map<string, HTMLImageElement>();
  #loaded = 0;                                   ///< of the images
  #machines = new Map<string, SVGSVGElement>();  ///< by run
  #asking = new Set<string>();

  componentDidMount(): void {
    addEventListener("keydown", this.#on_key);
    this.#cycle = this.#asked_cycle(this.props) ?? 0;
    this.#load();
  }

  componentWillUnmount(): void {
    removeEventListener("keydown", this.#on_key);
    cancelAnimationFrame(this.#frame);
  }

  componentWillReceiveProps(next: PageProps): void {
    const asked = this.#asked_cycle(next);
    if (this.state.playing || asked === null || Math.round(asked) === Math.round(this.#cycle)) return;
    this.#cycle = asked;
    this.setState({ cycle: asked });
  }

  componentDidUpdate(): void {
    this.#load();
    this.#draw();
    for (const run of this.#shown()) this.#light(run);
  }

  #light(run: Trajectory): void {
    const svg = this.#machines.get(run.id);
    if (svg) light(svg, run, this.state.cycle, this.state.chosen);
  }

  #asked_cycle({ query: { t } }: PageProps): number | null {
    return Number(t) >= 0 ? 10 * Number(t) : null;
  }

  #ids(): string[] {
    const { params, query } = this.props;
    return [...new Set([params.id, ...(query.beside ?? "").split(",")])].filter(Boolean).slice(0, kMostRuns);
  }

  /// The runs that have been loaded, in order.
  #shown(): Trajectory[] { return this.#ids().map((id) => this.state.runs[id]).filter(is_run); }

  #end(): number { return Math.max(1, ...this.#shown().map((run) => run.cycles)); }

  #speed(): number {
    const speed = Number(this.props.query.speed);
    return kSpeeds.includes(speed) ? speed : kUsualSpeed;
  }

  #trail(): string { return Object.keys(kTrails).find((name) => name === this.props.query.trail) ?? "10 s"; }

  #tint(): Tint {
    const tint = kTints.find(([, value]) => value === this.props.query.colour)?.[1] ?? "state";
    return tint === "state" && !this.#shown().some(has_states) ? "robot" : tint;
  }

  #load(): void {
    for (const id of this.#ids()) {
      if (this.state.runs[id] || this.#asking.has(id)) continue;
      this.#asking.add(id);
      const keep = (run: Trajectory | ApiError) => {
        this.#asking.delete(id);
        if (is_run(run)) this.#ask_for_images(run);
        this.setState({ runs: { ...this.state.runs, [id]: run } }, () => this.#begin());
      };
      ask(`${this.props.params.c}/runs/${id}/trajectory`).then((one) => keep(one.data as Trajectory), keep);
    }
  }

  /// Starts playing when the run is loaded, unless the address gives an instant, or the reader
  /// prefers reduced motion.
  #begin(): void {
    if (this.#has_begun || !is_run(this.state.runs[this.props.params.id])) return;
    this.#has_begun = true;
    const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
    if (this.#asked_cycle(this.props) === null && !calm) this.#play(); else this.#seek(this.#cycle);
  }

  // --- the clock ----------------------------------------------------------------------------------

  #play = (): void => {
    if (this.#cycle >= this.#end()) this.#cycle = 0;
    this.#last_frame = 0;
    this.setState({ playing: true });
    cancelAnimationFrame(this.#frame);
    this.#frame = requestAnimationFrame(this.#tick);
  };

  #pause = (): void => {
    cancelAnimationFrame(this.#frame);
    this.setState({ playing: false });
    this.#seek(Math.round(this.#cycle));
  };

  #toggle = (): void => (this.state.playing ? this.#pause() : this.#play());

  #tick = (now: number): void => {
    const past_s = this.#last_frame ? Math.min(0.25, (now - this.#last_frame) / 1000) : 0;
    this.#last_frame = now;
    this.#cycle = Math.min(this.#end(), this.#cycle + 10 * past_s * this.#speed());
    if (this.#cycle >= this.#end()) return this.#pause();
    this.#draw();
    if (now - this.#last_text > 90) {
      this.#last_text = now;
      this.setState({ cycle: Math.round(this.#cycle) });
    }
    this.#frame = requestAnimationFrame(this.#tick);
  };

  /// Moves to an instant and puts it into the address.
  #seek = (cycle: number): void => {
    this.#cycle = clamp(Math.round(cycle), 0, this.#end());
    this.setState({ cycle: this.#cycle, said: this.#sentence() });
    this.#draw();
    if (!this.state.playing) set_query({ t: String(this.#cycle / 10) });
  };

  #sentence(): string {
    const parts = this.#shown().map((run) => {
      const robots = run.robots.map((robot, at) => `robot ${at} ${doing(run, robot, this.#cycle)}`).join(", ");
      return `${run.id}: score ${number(this.#score(run))}; ${robots}`;
    });
    return `${seconds(this.#cycle)}. ${parts.join(". ")}`;
  }

  #score(run: Trajectory): number | null {
    return run.score_at[Math.min(Math.round(this.#cycle), run.score_at.length - 1)] ?? null;
  }

  #on_key = (event: KeyboardEvent): void => {
    if (is_typing(event)) return;
    const speeds = (by: number) =>
      set_query({ speed: kSpeeds[clamp(kSpeeds.indexOf(this.#speed()) + by, 0, kSpeeds.length - 1)] });
    const actions: Record<string, () => void> = {
      ArrowLeft: () => this.#seek(this.#cycle - 10), ArrowRight: () => this.#seek(this.#cycle + 10),
      ",": () => this.#step(-1), ".": () => this.#step(1), "[": () => speeds(-1), "]": () => speeds(1),
      Home: () => this.#seek(0), End: () => this.#seek(this.#end()), " ": this.#toggle,
    };
    // A button or a link with the focus handles the space bar itself.
    const act = actions[event.key];
    if (!act || event.key === " " && /^(BUTTON|A|SUMMARY)$/.test((event.target as Element).tagName)) return;
    event.preventDefault();
    act();
  };

  #step(by: number): void {
    if (this.state.playing) this.#pause();
    this.#seek(Math.round(this.#cycle) + by);
  }

  // --- drawing ------------------------------------------------------------------------------------

  #draw = (): void => {
    this.#canvases.forEach((canvas) => canvas.paint());
    this.#strip?.paint();
  };

  /// Fetches the pictures on the floor, and draws the floor again when they have arrived.
  #ask_for_images({ arena: { patches } }: Trajectory): void {
    for (const { image } of patches) {
      if (!image || this.#images.has(image)) continue;
      const picture = new Image();
      picture.onload = () => { ++this.#loaded; this.#draw(); };
      picture.src = image;
      this.#images.set(image, picture);
    }
  }

  #choose(robot: number | null): void {
    this.setState({ chosen: robot === this.state.chosen ? null : robot });
  }

  // --- beside -------------------------------------------------------------------------------------

  #put_beside = (ids: string[]): void => { set_query({ beside: ids.filter(Boolean).join(",") }, true); };

  render({ params: { id } }: PageProps) {
    const run = this.state.runs[id];
    const ids = this.#ids();
    return <div>
      <h1>Run {id} {is_run(run) && <small>{words(run.mission)}{run.design && [", design ", link(run.design)]}</small>}</h1>
      {this.#controls()}
      <div class={ids.length === 1 ? "runs alone" : "runs"}>{ids.map((one) => this.#panel(one))}</div>
      <p class="unseen" role="status">{this.state.playing ? "" : this.state.said}</p>
      {is_run(run) && run.verdict && <Checks checks={run.checks ?? null} />}
      {is_run(run) && <div class="grid">{ids.length < kMostRuns && this.#beside(run)}{this.#elsewhere(run)}</div>}
    </div>;
  }

  #controls() {
    const { playing, cycle } = this.state;
    const end = this.#end();
    const button = (act: () => void, mark: string, label: string, key: string) => <button onClick={act} aria-label={label} aria-keyshortcuts={key}>{mark}</button>;
    return <section class="panel player" aria-label="player">
      <div class="tools">
        <button class="main play" onClick={this.#toggle} aria-keyshortcuts="Space">{playing ? "Pause" : "Play"}</button>
        {button(() => this.#seek(0), "«", "to the start", "Home")}
        {button(() => this.#step(-1), "‹", "one cycle back", ",")}
        {button(() => this.#step(1), "›", "one cycle forward", ".")}
        <output class="time">{seconds(cycle)} <span class="faint">of {seconds(end)}</span></output>
        <span class="push" />
        <Choice label="Speed" value={String(this.#speed())} options={kSpeeds.map((speed) => [`${speed}×`, String(speed)])} />
        <Choice label="Trails" name="trail" value={this.#trail()} options={Object.keys(kTrails)} />
        <Choice label="Colour by" name="colour" value={this.#tint()} options={kTints} />
      </div>
      <Slider label="time" text={seconds(cycle)} max={end} value={cycle} to={this.#seek} />
      <Canvas ref={(it: any) => { this.#strip = it; }} height={() => 46}
        label={`Score so far, higher is better: ${this.#shown().map((one) => `${one.id} ${number(this.#score(one))}`).join(", ")}`}
        draw={(pen) => draw_scores(pen, this.#shown(), this.#cycle)}
        attributes={{ onClick: (event: MouseEvent) => this.#seek(end * event.offsetX / (event.target as HTMLElement).clientWidth) }} />
      <p><small>Below the slider: the score so far (higher is better). Space plays, <kbd>←</kbd> <kbd>→</kbd> one second, <kbd>,</kbd> <kbd>.</kbd> one cycle, <kbd>[</kbd> <kbd>]</kbd> speed. Click a robot to follow it.</small></p>
    </section>;
  }

  #panel(id: string) {
    const run = this.state.runs[id];
    const { cycle, chosen } = this.state;
    const section = (title: any, content: any) => <section key={id} class="panel run" data-run={id} aria-label={`run ${id}`}>
      <div class="panel-head"><h2>{title}</h2>{id !== this.props.params.id
        && <Quiet label={`take ${id} away`} act={() => this.#put_beside(this.#ids().slice(1).filter((other) => other !== id))}>✕</Quiet>}</div>
      {content}
    </section>;
    if (!run) return section(id, <Waiting />);
    if (!is_run(run)) return section(id, "nothing" in run ? <Empty>{(run as any).nothing}</Empty> : <Failure error={run} />);
    return section([run.verdict && `${run.id} ${run.name ?? ""}, `, run.candidate && link(run.candidate), run.seed !== null && `, seed ${run.seed}`, `, ${run.source}`], [
      <Canvas ref={(it: any) => { if (it) this.#canvases.set(id, it); else this.#canvases.delete(id); }}
        label={`${words(run.mission)} from above, ${run.robots.length} robots, at ${seconds(cycle)}`}
        height={(width) => Math.min(width * shape_of(run.arena), 640)}
        ground={(pen) => draw_place(pen, run.arena, this.#images)} ground_key={[run, this.#loaded]}
        draw={(pen) => draw_run(pen, run, { cycle: this.#cycle, trail_cycles: kTrails[this.#trail()], tint: this.#tint(), chosen: this.state.chosen })}
        attributes={{ onClick: ({ offsetX, offsetY, target }: MouseEvent) => {
          const { clientWidth, clientHeight } = target as Element;
          this.#choose(robot_at(run, this.#cycle, clientWidth, clientHeight, offsetX, offsetY));
        } }} />,
      pairs("facts", [
        ["score so far", <span data-what="score">{number(this.#score(run))}</span>],
        ["at the end", number(run.score)],
        run.verdict ? ["verdict", [run.verdict, not_checked(run.checks)]]
          : ["simulated again", run.same_bits === null ? <small>nothing is stored to compare it with</small>
            : run.same_bits ? <span class="good" title={`state digest ${run.digest}`}>✓ same bits</span>
              : <span class="warn">differs: the store has {number(run.stored_score)}</span>]]),
      this.#robots(run, chosen),
      run.candidate && has_states(run) && <Machine of={run.candidate} placed={(svg) => { this.#machines.set(id, svg); this.#light(run); }} />]);
  }

  #robots(run: Trajectory, chosen: number | null) {
    const { cycle } = this.state;
    const has_kinds = run.robots.some((one) => one.kind?.length);
    const by_state = this.#tint() === "state";
    const { robots } = run;
    const poses = robots.map((robot) => pose_at(robot, cycle));
    return <details open={robots.length <= 6}>
      <summary>{robots.length} robots at {seconds(cycle)}</summary>
      <Table<number> name={"o" + run.id} caption={`robots of ${run.id}`} rows={[...robots.keys()]} page_size={100}
        row_class={(at) => at === chosen && "chosen"} columns={[
          { key: "robot", value: (at) => at, numeric: false, show: (at) => {
            const color = (by_state ? value_at(robots[at].state, cycle) : null) ?? at;
            return <Quiet aria-pressed={chosen === at ? "true" : "false"} act={() => this.#choose(at)}>
              <svg class="dot" viewBox="0 0 10 10" aria-hidden="true"><circle cx="5" cy="5" r="4.5" fill={kDistinct[color % kDistinct.length]} /></svg>
              {at} {robots[at].name}</Quiet>;
          } },
          { key: "does", value: (at) => doing(run, robots[at], cycle) || null },
          ...(has_kinds ? [{ key: "pose is", value: (at: number) => value_at(robots[at].kind, cycle) }] : []),
          ...(["x", "y"] as const).map((key) => ({ key, label: key + ", m", value: (at: number) => poses[at]?.[key], show: (at: number) => metres(poses[at]?.[key]) }))]} />
    </details>;
  }

  #beside({ id, verdict, candidate, source, design, profiles, seed: own_seed }: Trajectory) {
    const seed = own_seed ?? 1;
    const put = (one: string) => this.#put_beside([...this.#ids().slice(1), one]);
    /// The pairs of a run and its name that are not shown yet.
    const offer = (name: string, runs: [string, string][]) => {
      const open = runs.filter(([one]) => !this.#ids().includes(one));
      return open.length > 0 && <p class="tools"><span class="faint">{name}</span> {open.map(([one, text]) => <button onClick={() => put(one)}>{text}</button>)}</p>;
    };
    return <Panel title="Put another run beside it">
      {verdict ? candidate && offer("Simulated from the same starts:", [1, 2, 3].map((n) => [`${id}-${n}`, `seed ${n}`]))
        : offer("The same under:", (profiles ?? []).filter((name) => name !== source).map((name) => [`${candidate}-${seed}@${name}`, name]))}
      {design && !verdict && <Get<DesignAnswer> path={`${this.props.params.c}/designs/${design}`} render={({ elites }) => {
        const last = Math.max(0, ...elites.map((one) => one.iteration));
        return offer("On the same seed, elites:", elites.filter((one) => one.iteration === last && "c" + one.candidate !== candidate).slice(0, 4)
          .map((one) => [`c${one.candidate}-${seed}`, "c" + one.candidate])) || null;
      }} />}
      <form class="tools" onSubmit={(event) => {
        event.preventDefault();
        put(this.state.wanted.trim());
        this.setState({ wanted: "" });
      }}>
        <label>Run <input name="beside" value={this.state.wanted} autocomplete="off" size={14} onInput={(event) => this.setState({ wanted: typed(event) })} /></label>
        <button type="submit">Put beside</button>
      </form>
      <p><small>An evaluation (e81200007), a candidate and a seed (c812-{seed}), or a real run (r7). All runs share one clock.</small></p>
    </Panel>;
  }

  #elsewhere({ id, candidate, seed }: Trajectory) {
    const line = `swarmsmith replay ${id.includes("-") ? candidate : id} ${store_word()} ${id.includes("-") ? `--seed ${seed} ` : ""}--csv run.csv`;
    return <Panel title="Elsewhere">
      <p><a href={`api/v1/${this.props.params.c}/runs/${id}/trajectory.csv`} download={`${id}.csv`}>All poses as CSV</a></p>
      <p><code>{line}</code> <Copy text={line} /></p>
    </Panel>;
  }
}
