import { Component, h } from "preact";
import { is_snapshot, path_of } from "../api";
import { announce, command, Copy, Empty, link, pairs, Panel, place_of, Quiet, Slider, Table } from "../components";
import { Files } from "../figure";
import { Canvas, Pen, Point, viridis } from "../canvas";
import { clamp, count, number, whole, words } from "../format";
import { Get } from "../get";
import { PageProps } from "../page";
import { go, set_query } from "../route";
import { Race } from "../types";
import { said } from "./campaigns";
import { design_title, kNoRace } from "./design";

// Sizes of the parts of the picture, in CSS pixels.
const kLeft = 86, kRight = 16, kAlive = 46, kMarks = 18, kTop = kAlive + kMarks, kBottom = 18;

/// The data of the matrix, from an answer.
class Matrix {
  constructor(readonly race: Race) {}

  /// 1 is best, ties share their mean rank; null without a score.
  rank({ row, step }: At): number | null { return this.race.ranks[step][row] ?? null; }

  /// The rank of a cell from 0 (best) to 1 (worst). If all are equal in a step, they have the value
  /// in the middle.
  part(at: At): number | null {
    const rank = this.rank(at), ranked = this.race.ranked[at.step];
    return rank === null ? null : ranked < 2 ? 0.5 : (rank - 1) / (ranked - 1);
  }

  /// The number of the step that dropped a row's candidate; null if that was after `until` or
  /// never.
  dropped(row: number, until: number): number | null {
    const at = this.race.dropped_at[row];
    return at !== null && at <= until ? at : null;
  }

  /// null: not evaluated.
  score({ row, step }: At): number | null { return this.race.scores[step][row] ?? null; }

  /// A rejected run has no score.
  has_run(at: At): boolean { return this.score(at) !== null || this.race.dropped_at[at.row] === this.race.steps[at.step] && this.race.reasons[at.row] === "rejected"; }

  run_of({ row, step }: At): string { return evaluation_id(this.race.candidates[row], this.race.pairs[step]); }

  /// A description of a cell in words.
  sentence(at: At): string {
    const { race } = this;
    const { row, step } = at;
    const score = this.score(at), dropped = race.dropped_at[row], now = race.steps[step], reason = race.reasons[row];
    const what = score !== null
      ? `score ${number(score, 6)}, rank ${number(this.rank(at))} of ${race.ranked[step]}` + (dropped === now ? `, dropped after it: ${reason}` : "")
      : this.has_run(at) ? reason : dropped !== null && dropped < now ? `dropped after step ${dropped}: ${reason}` : "not evaluated";
    return `c${race.candidates[row]}, step ${now}, instance ${race.instances[step]}, seed ${race.seeds[step]}: ${what}`;
  }
}

interface At { row: number; step: number }  // indices

interface MapProps {
  matrix: Matrix;
  until: number;               ///< index of the last step that is shown
  cell: At | null;
  pick: (at: At | null) => void;
  watch: (at: At) => void;
  label: string;
}

/// The matrix as a picture, with a cursor that follows the pointer and the arrow keys.
class RaceMap extends Component<MapProps, { hover: At | null }> {
  state: { hover: At | null } = { hover: null };
  #width = 0;

  /// The size of a cell, in pixels.
  #size(): { column: number; row: number } {
    const { candidates, steps } = this.props.matrix.race;
    return { column: Math.min(96, (this.#width - kLeft - kRight) / steps.length),
      row: clamp(Math.floor(620 / candidates.length), 2, 16) };
  }

  #height = (width: number) => {
    this.#width = width;
    return kTop + this.props.matrix.race.candidates.length * this.#size().row + kBottom;
  };

  #draw_cells = (pen: Pen) => {
    const { matrix, until } = this.props;
    const { race } = matrix;
    const { column, row } = this.#size();
    const { dark, inks } = pen;
    const columns = race.steps.length;
    const now = race.steps[until];
    const x_of = (step: number) => kLeft + step * column;
    const vermilion = dark ? "#ff7b2e" : "#d55e00";
    const gap_x = column >= 6 ? 0.5 : 0, gap_y = row >= 6 ? 0.5 : 0, mark = Math.min(4, row);
    race.candidates.forEach((candidate, i) => {
      const y = kTop + i * row;
      const dropped = matrix.dropped(i, now);
      const end = dropped === null ? until + 1 : race.steps.indexOf(dropped) + 1;
      // Grey after a candidate was dropped; the background colour where it was not evaluated.
      pen.box(inks.soft, x_of(end), y, (until + 1 - end) * column, row);
      for (let s = 0; s <= until; ++s) {
        const at = { row: i, step: s }, part = matrix.part(at);
        // The best cells have the strongest contrast to the background.
        if (part !== null || matrix.has_run(at)) pen.box(part === null ? vermilion : viridis(dark ? part : 1 - part), x_of(s), y, Math.max(column - gap_x, 0.7), row - gap_y);
      }
      if (dropped !== null && race.reasons[i] !== "not kept") pen.box(vermilion, x_of(end) - 1, y, 2.5, row);
      if (race.elite_before[i]) pen.box(inks.ink, kLeft - 6, y + (row - mark) / 2, 4, mark);
      if (race.elite_after[i] && until === columns - 1) pen.box(inks.ink, x_of(columns) + 4, y + (row - mark) / 2, 4, mark);
      if (i % Math.ceil(12 / row) === 0) pen.say("c" + candidate, kLeft - 9, y + Math.max(row, 4) / 2, "right");
    });
    // Above: how many candidates were alive after each step, and markers: letters if they fit, else
    // a line where candidates were dropped.
    const most = Math.max(1, race.rows_total);
    const y_of = (alive: number) => kAlive - 2 - (alive / most) * (kAlive - 10);
    const curve: Point[] = [[kLeft, y_of(most)]];
    for (let s = 0; s <= until; ++s) {
      curve.push([x_of(s + 1), curve[curve.length - 1][1]], [x_of(s + 1), y_of(race.alive[s])]);
      const fell = /[-c]/.test(race.markers[s]);
      if (column >= 8) pen.say(race.markers[s], x_of(s + 0.5), kAlive + kMarks / 2, "center", fell ? vermilion : inks.faint);
      else if (fell) pen.box(vermilion, x_of(s), kAlive + 6, Math.max(1, column), 8);
    }
    pen.path(curve).stroke(inks.link, 1.5);
    pen.say(whole(most), kLeft - 9, y_of(most) + 4, "right");
    pen.say("alive", kLeft - 9, y_of(0) - 4, "right");
    pen.say(whole(race.alive[until]), x_of(until + 1) + 4, y_of(race.alive[until]), "left");
    // Below: step numbers, as many as fit.
    const y = pen.height - kBottom / 2 + 2;
    for (let s = 0; s < columns; s += Math.ceil(46 / column)) pen.say(String(race.steps[s]), x_of(s + 0.5), y);
    pen.say("step", kLeft - 9, y, "right");
  };

  #draw_cursors = ({ to, inks }: Pen) => {
    const { column, row } = this.#size();
    const frame = (at: At | null, width: number) => {
      if (!at) return;
      for (const [color, thick] of [[inks.paper, 4], [inks.ink, width]] as const) {
        to.strokeStyle = color;
        to.lineWidth = thick;
        to.strokeRect(kLeft + at.step * column - 0.5, kTop + at.row * row - 0.5, Math.max(column, 4), Math.max(row, 4));
      }
    };
    frame(this.state.hover, 1);
    frame(this.props.cell, 2);
  };

  #at({ offsetX, offsetY }: MouseEvent): At | null {
    const { until, matrix } = this.props;
    const size = this.#size();
    const step = Math.floor((offsetX - kLeft) / size.column), row = Math.floor((offsetY - kTop) / size.row);
    return step >= 0 && step <= until && row >= 0 && row < matrix.race.candidates.length ? { row, step } : null;
  }

  #key = (event: KeyboardEvent) => {
    const { matrix, until, cell, pick, watch } = this.props;
    const { key } = event;
    const last_row = matrix.race.candidates.length - 1;
    const { row, step } = cell ?? { row: 0, step: until };
    const far = event.shiftKey ? 10 : 1;
    const moves: Record<string, [row: number, step: number]> = {
      ArrowLeft: [row, step - far], ArrowRight: [row, step + far], ArrowUp: [row - far, step], ArrowDown: [row + far, step],
      Home: [row, 0], End: [row, until], PageUp: [0, step], PageDown: [last_row, step],
    };
    if (moves[key]) {
      event.preventDefault();
      const [to_row, to_step] = cell ? moves[key] : [row, step];
      const next = { row: clamp(to_row, 0, last_row), step: clamp(to_step, 0, until) };
      pick(next);
      announce(matrix.sentence(next));
    } else if (cell && key === "Enter") {
      event.preventDefault();
      watch(cell);
    } else if (cell && key === "Escape") {
      pick(null);
    }
  };

  render({ matrix, until, pick, watch, label, cell }: MapProps, { hover }: { hover: At | null }) {
    const at = hover ?? cell;
    return <div class="race-map">
      <Canvas label={label} height={this.#height} ground={this.#draw_cells} ground_key={[matrix, until]} draw={this.#draw_cursors} attributes={{
        role: "application", tabIndex: 0, "aria-roledescription": "race matrix", class: "pointed", "aria-describedby": "race-help",
        onMouseMove: (event: MouseEvent) => {
          const it = this.#at(event);
          if (it?.row !== hover?.row || it?.step !== hover?.step) this.setState({ hover: it });
        },
        onMouseLeave: () => this.setState({ hover: null }),
        onClick: (event: MouseEvent) => pick(this.#at(event)),
        onDblClick: (event: MouseEvent) => { const it = this.#at(event); if (it) watch(it); },
        onKeyDown: this.#key,
      }} />
      <p class="hover-line" aria-hidden="true">{at ? matrix.sentence(at) : "Point at a cell, or move with the arrows: its score, rank and seed appear here."}</p>
      <p id="race-help" class="unseen">Arrows move by a cell, with shift by ten; Home and End to the first and last step, Page Up and Page Down to the best and last candidate; Enter watches the run.</p>
    </div>;
  }
}

/// The evaluation's id as users type it.
function evaluation_id(candidate: number, pair: number): string { return `e${candidate * 100000 + pair}`; }

const kLegend = [["viridis", "rank, best to worst"], ["dropped-end", "dropped here; whole cell: rejected"], ["gone", "no longer in the race"], ["elite", "elite before (left), after (right)"]];

export class RacePage extends Component<PageProps, { is_asked?: boolean }> {
  #matrix?: Matrix;

  #cell({ race }: Matrix, until: number): At | null {
    const [, candidate, at] = /^c(\d+)(?:,(\d+))?$/.exec(this.props.query.cell ?? "") ?? [];
    const row = race.candidates.indexOf(Number(candidate));
    if (row < 0) return null;
    let step = race.steps.indexOf(Number(at));
    // If only a candidate is given: its last cell.
    if (step < 0) for (step = until; step > 0 && (race.scores[step][row] ?? null) === null;) --step;
    return { row, step: Math.min(step, until) };
  }

  #race(race: Race) {
    const { design: { id }, query } = this.props;
    const { steps, candidates, iteration, ended, rows_total, title, note } = race;
    if (steps.length === 0) return <Empty>No step of this race has ended yet.</Empty>;
    if (this.#matrix?.race !== race) this.#matrix = new Matrix(race);
    const matrix = this.#matrix;
    const last = steps.length - 1;
    const wanted = steps.indexOf(Number(query.step));
    const until = wanted < 0 ? last : wanted;
    const cell = this.#cell(matrix, until);
    const pick = (at: At | null) => set_query({ cell: at && `c${candidates[at.row]},${steps[at.step]}` });
    const watch = (at: At) => { if (matrix.has_run(at)) go(place_of(matrix.run_of(at))); };
    const now = steps[until];
    const fallen = candidates.filter((_, row) => matrix.dropped(row, now) !== null).length;
    return <div class="beside">
      <Panel title={`${title}${ended ? "" : ", running"}: candidates by step`}
        command={command("figure race", `--design ${id} --iteration ${iteration} -o race.svg`)}
        sql={`SELECT * FROM v_race_matrix WHERE design = ${id.slice(1)} AND iteration = ${iteration}`}
        tools={<Files kind="race" name="race" options={{ design: id, iteration }} />}>
        {note && <p>{note}</p>}
        <div class="slider"><label for="step">after step {now}{until === last && !ended && ", the newest"}</label>
          <Slider id="step" max={last} value={until} text={`step ${now}, ${race.alive[until]} alive`} to={(step) => set_query({ step: step === last ? null : steps[step] })} />
          <span class="faint">{until < last ? `as it was then; ${count(last - until, "later step")} hidden` : count(last + 1, "step")}</span>
        </div>
        <RaceMap matrix={matrix} until={until} cell={cell} pick={pick} watch={watch}
          label={`${title} of ${id}: ${count(candidates.length, "candidate")}, best first, by ${count(until + 1, "step")}; ${fallen} dropped, ${race.alive[until]} alive. The table below has the same.`} />
        <ul class="legend">{kLegend.map(([mark, what]) => <li><span class={"swatch " + mark} /> {what}</li>)}</ul>
        {rows_total > candidates.length && <p class="faint">The best {whole(candidates.length)} of {whole(rows_total)} candidates. <Quiet act={() => set_query({ rows: rows_total })}>Show all</Quiet></p>}
      </Panel>
      <div class="side">
        <Panel title="Cell">{cell ? this.#chosen(matrix, cell, watch) : <Empty>Click a cell to see what made its score, and to watch the run.</Empty>}</Panel>
        <Panel title={`Step ${now}`}>{step_facts(race, until)}</Panel>
      </div>
      <Panel wide title={`Candidates after step ${now}`}>{candidates_table(matrix, until)}</Panel>
    </div>;
  }

  #chosen(matrix: Matrix, at: At, watch: (at: At) => void) {
    const { race } = matrix;
    const { row, step } = at;
    const score = matrix.score(at), dropped = race.dropped_at[row];
    const id = matrix.run_of(at);
    const { is_asked } = this.state;
    return <div>
      {pairs("facts", [
        ["candidate", link("c" + race.candidates[row])],
        ["score", number(score, 6), "higher is better"],
        ["rank", [number(matrix.rank(at)), <small> of {race.ranked[step]}</small>]]])}
      <p>Step {race.steps[step]}, instance {race.instances[step]}, seed {race.seeds[step]}. {dropped !== null ? `Dropped after step ${dropped}: ${race.reasons[row]}.` : race.elite_after[row] ? "An elite after this race." : race.ended ? "It survived the race." : "It is alive."}</p>
      {!matrix.has_run(at) ? <p class="faint">It was not evaluated here.</p> : [
        <p class="tools"><button class="main" onClick={() => watch(at)}>Watch this run</button><Copy text={command(`explain ${id}`)} /></p>,
        <p><button aria-expanded={!!is_asked} onClick={() => this.setState({ is_asked: !is_asked })}>Who made it</button></p>,
        is_asked && <Get<Record<string, unknown>> path={`${this.props.params.c}/evaluations/${id}`} keep render={(answer) =>
          pairs("pairs", Object.entries(answer).map(([name, value]) => name !== "v" && said(value) && [words(name), said(value)]))} />]}
    </div>;
  }

  render({ params, query, design }: PageProps) {
    const { id } = design;
    const newest = Math.max(1, design.iteration);
    const to = (iteration: number) => go(`${place_of(id)}/race/${iteration}`);
    const choice = (shown: number) => {
      const turn = (by: number, mark: string, label: string) =>
        <Quiet label={"iteration " + label} disabled={shown + by < 1 || shown + by > newest} act={() => to(shown + by)}>{mark}</Quiet>;
      return <div class="slider"><label for="iteration">iteration {shown}{shown > newest ? `; the newest is ${newest}` : ` of ${newest}`}</label>
        {turn(-1, "‹", "before")}<Slider id="iteration" min={1} max={newest} value={shown} to={to} />{turn(1, "›", "after")}
        {params.iteration && (shown !== newest || design.state === "racing") && <a href={place_of(id) + "/race"}>the newest</a>}
      </div>;
    };
    const asked = params.iteration ? Number(params.iteration) : design.state === "racing" && !is_snapshot ? null : newest;
    // During a race: the newest iteration that has a step, unless another one is asked for.
    return <div>
      {design_title(design)}
      {design.iteration === 0 ? <Empty>{design.state === "finished" ? kNoRace : "No step of the race has ended yet: its cells appear one by one."}</Empty>
        : <Get<Race> path={path_of(`${params.c}/designs/${id}/race`, { iteration: asked, rows: query.rows })} keep
          version={asked && asked < design.iteration ? "ended" : design.version} render={(race) => <div>{choice(race.iteration)}{this.#race(race)}</div>} />}
    </div>;
  }
}

function step_facts(race: Race, until: number) {
  const p = race.p_value[until], best = race.best[until];
  return pairs("facts", [
    ["test", [<code>{race.markers[until]}</code>, " ", <span class="small">{race.meanings[until]}</span>]],
    ["p value", p !== null && p < 0.0001 ? "< 0.0001" : number(p, 3)],
    ["alive", whole(race.alive[until])],
    ["best", best ? link("c" + best) : "–"],
    ["its mean", number(race.mean_best[until])]]);
}

function candidates_table(matrix: Matrix, until: number) {
  const { candidates, steps, scores, reasons, elite_before, elite_after } = matrix.race;
  const now = steps[until];
  const rows = candidates.map((candidate, row) => {
    const own = scores.slice(0, until + 1).map((step) => step[row] ?? null).filter((score): score is number => score !== null);
    const dropped = matrix.dropped(row, now);
    return { candidate, dropped, n: own.length, mean: own.length ? own.reduce((a, b) => a + b) / own.length : null, reason: dropped === null ? null : reasons[row],
      elite: [elite_before[row] && "before", elite_after[row] && "after"].filter(Boolean).join(" and ") };
  });
  return <Table name="r" caption={`Candidates after step ${now}`} rows={rows} columns={["candidate",
    { key: "mean", label: "mean score here", title: "over the pairs of this race; higher is better" },
    { key: "n", label: "pairs" }, { key: "dropped", label: "dropped after step" }, { key: "reason", label: "why" }, "elite",
    { key: "cell", show: ({ candidate }) => <Quiet act={() => set_query({ cell: "c" + candidate })}>show</Quiet> }]} />;
}
