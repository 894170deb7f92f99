import { Component, h } from "preact";
import { path_of } from "../api";
import { announce, Copy, Empty, Fact, Panel, Table, To } from "../components";
import { Files } from "../figure";
import { Canvas, Inks, pen, viridis } from "../canvas";
import { count, number, shell_word, whole } from "../format";
import { Get } from "../get";
import { Page, PageProps } from "../page";
import { go, href, set_query } from "../route";
import { Campaign, Design, Race } from "../types";
import { said } from "./campaigns";
import { DesignTitle, find_design, NoDesign } from "./design";

const kMarkers: Record<string, string> = {
  "x": "no test", "-": "the test dropped some", "=": "the test dropped nobody", "!": "only protected elites would have been dropped",
  ".": "nobody had to run", "c": "capping alone dropped some", ":": "only elites had to run", "?": "not known",
};
const kRows = 400;
// Parts of the picture, in CSS pixels.
const kLeft = 86, kRight = 16, kAlive = 46, kMarks = 18, kTop = kAlive + kMarks, kBottom = 18;

/// What the matrix shows, made once of an answer: the rank of each cell as a part from 0 (best) to 1.
class Matrix {
  readonly rank: (number | null)[][];   ///< [step][candidate], 1 is best, ties share their mean rank
  readonly ranked: number[];            ///< how many had a score in the step
  readonly known: Map<number, number>;  ///< candidate to row

  constructor(readonly race: Race) {
    this.rank = race.scores.map(ranks);
    this.ranked = this.rank.map((step) => step.reduce<number>((n, one) => n + (one === null ? 0 : 1), 0));
    this.known = new Map(race.candidates.map((candidate, row) => [candidate, row]));
  }

  /// 0 is best; a step in which all are the same has the middle throughout.
  part(step: number, row: number): number | null {
    const rank = this.rank[step][row] ?? null;
    if (rank === null) return null;
    return this.ranked[step] < 2 ? 0.5 : (rank - 1) / (this.ranked[step] - 1);
  }

  /// The number of the last step that a row's candidate was in the race, as it was after `until`.
  dropped(row: number, until: number): number | null {
    const at = this.race.dropped_at[row];
    return at !== null && at <= until ? at : null;
  }

  /// Mean of a row's scores up to a step (an index), and over how many.
  mean(row: number, until: number): { mean: number | null; n: number } {
    let [sum, n] = [0, 0];
    for (let i = 0; i <= until; ++i) {
      const score = this.race.scores[i][row];
      if (score !== null && score !== undefined) { sum += score; ++n; }
    }
    return { mean: n ? sum / n : null, n };
  }
}

/// Ranks of scores, largest first; null where there is none.
export function ranks(scores: (number | null)[]): (number | null)[] {
  const order = scores.map((score, i) => ({ score, i })).filter((one) => one.score !== null && one.score !== undefined)
    .sort((a, b) => b.score! - a.score!);
  const result: (number | null)[] = scores.map(() => null);
  for (let i = 0; i < order.length;) {
    let end = i;
    while (end < order.length && order[end].score === order[i].score) ++end;
    for (let k = i; k < end; ++k) result[order[k].i] = (i + 1 + end) / 2;
    i = end;
  }
  return result;
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

/// The matrix as a picture, with a cursor that pointer and arrows move.
class RaceMap extends Component<MapProps, { hover: At | null }> {
  state: { hover: At | null } = { hover: null };
  private picture: HTMLCanvasElement | null = null;
  private key: unknown[] = [];
  private area = { width: 0, column: 0, row: 0 };

  private row_height(): number {
    const rows = this.props.matrix.race.candidates.length;
    return Math.max(2, Math.min(16, Math.floor(620 / Math.max(1, rows))));
  }

  private height = () => kTop + this.props.matrix.race.candidates.length * this.row_height() + kBottom;

  private draw = (context: CanvasRenderingContext2D, width: number, height: number, inks: Inks) => {
    const { matrix, until, cell } = this.props;
    const columns = matrix.race.steps.length;
    this.area = { width, column: Math.min(48, (width - kLeft - kRight) / Math.max(1, columns)), row: this.row_height() };
    const dark = document.documentElement.dataset.theme === "dark";
    const scale = context.canvas.width / width;
    const key = [matrix, until, width, dark, scale];
    if (!this.picture || key.some((part, i) => part !== this.key[i])) {
      this.key = key;
      this.picture = document.createElement("canvas");
      this.picture.width = context.canvas.width;
      this.picture.height = context.canvas.height;
      const below = this.picture.getContext("2d")!;
      below.scale(scale, scale);
      this.paint(below, inks, dark);
    }
    context.drawImage(this.picture, 0, 0, width, height);
    for (const at of [this.state.hover, cell]) if (at) this.frame(context, at, inks, at === cell);
  };

  private paint(to: CanvasRenderingContext2D, inks: Inks, dark: boolean) {
    const { matrix, until } = this.props;
    const { race } = matrix;
    const { column, row } = this.area;
    const { box, say, line } = pen(to, inks);
    const rows = race.candidates.length, columns = race.steps.length;
    const now = race.steps[until];
    const x_of = (step: number) => kLeft + step * column;
    const vermilion = dark ? "#ff7b2e" : "#d55e00";
    const gap_x = column >= 6 ? 0.5 : 0, gap_y = row >= 6 ? 0.5 : 0, mark = Math.min(4, row);
    race.candidates.forEach((candidate, i) => {
      const y = kTop + i * row;
      const dropped = matrix.dropped(i, now);
      const end = dropped === null ? until + 1 : race.steps.indexOf(dropped) + 1;
      // Grey where a candidate had fallen, the ground of what has not been evaluated.
      box(inks.soft, x_of(end), y, (until + 1 - end) * column, row);
      for (let s = 0; s <= until; ++s) {
        const part = matrix.part(s, i);
        // The best is farthest from the ground.
        if (part !== null) box(viridis(dark ? part : 1 - part), x_of(s), y, Math.max(column - gap_x, 0.7), row - gap_y);
      }
      if (dropped !== null && race.reasons[i] !== "not kept") box(vermilion, x_of(end) - 1, y, 2.5, row);
      if (race.elite_before[i]) box(inks.ink, kLeft - 6, y + (row - mark) / 2, 4, mark);
      if (race.elite_after[i] && until === columns - 1) box(inks.ink, x_of(columns) + 4, y + (row - mark) / 2, 4, mark);
      if (i % Math.ceil(12 / row) === 0) say("c" + candidate, kLeft - 9, y + Math.max(row, 4) / 2, "right");
    });
    // Above: how many were alive after each step, and markers: letters where they fit, else a tick where some fell.
    const most = Math.max(1, race.rows_total);
    const y_of = (alive: number) => kAlive - 2 - (alive / most) * (kAlive - 10);
    const curve: [number, number][] = [[kLeft, y_of(most)]];
    for (let s = 0; s <= until; ++s) {
      curve.push([x_of(s + 1), curve[curve.length - 1][1]], [x_of(s + 1), y_of(race.alive[s])]);
      const fell = /[-c]/.test(race.markers[s]);
      if (column >= 8) say(race.markers[s], x_of(s + 0.5), kAlive + kMarks / 2, "center", fell ? vermilion : inks.faint);
      else if (fell) box(vermilion, x_of(s), kAlive + 6, Math.max(1, column), 8);
    }
    line(inks.link, curve);
    say(whole(most), kLeft - 9, y_of(most) + 4, "right");
    say("alive", kLeft - 9, y_of(0) - 4, "right");
    say(whole(race.alive[until]), x_of(until + 1) + 4, y_of(race.alive[until]), "left");
    // Below: steps, as many as there is room for.
    const y = kTop + rows * row + kBottom / 2 + 2;
    for (let s = 0; s < columns; s += Math.ceil(46 / column)) say(String(race.steps[s]), x_of(s + 0.5), y);
    say("step", kLeft - 9, y, "right");
  }

  private frame(to: CanvasRenderingContext2D, { row, step }: At, inks: Inks, chosen: boolean) {
    const x = kLeft + step * this.area.column, y = kTop + row * this.area.row;
    to.strokeStyle = inks.paper;
    to.lineWidth = 4;
    const w = Math.max(this.area.column, 4), tall = Math.max(this.area.row, 4);
    to.strokeRect(x - 0.5, y - 0.5, w, tall);
    to.strokeStyle = inks.ink;
    to.lineWidth = chosen ? 2 : 1;
    to.strokeRect(x - 0.5, y - 0.5, w, tall);
  }

  private at(event: MouseEvent): At | null {
    const box = (event.target as Element).getBoundingClientRect();
    const step = Math.floor((event.clientX - box.left - kLeft) / this.area.column);
    const row = Math.floor((event.clientY - box.top - kTop) / this.area.row);
    return step >= 0 && step <= this.props.until && row >= 0 && row < this.props.matrix.race.candidates.length ? { row, step } : null;
  }

  private key_down = (event: KeyboardEvent) => {
    const { matrix, until, cell, pick, watch } = this.props;
    const last_row = matrix.race.candidates.length - 1;
    const from = cell ?? { row: 0, step: until };
    const far = event.shiftKey ? 10 : 1;
    const moves: Record<string, At> = {
      ArrowLeft: { row: from.row, step: from.step - far }, ArrowRight: { row: from.row, step: from.step + far },
      ArrowUp: { row: from.row - far, step: from.step }, ArrowDown: { row: from.row + far, step: from.step },
      Home: { row: from.row, step: 0 }, End: { row: from.row, step: until },
      PageUp: { row: 0, step: from.step }, PageDown: { row: last_row, step: from.step },
    };
    const to = moves[event.key];
    if (to) {
      event.preventDefault();
      const next = cell ? { row: Math.max(0, Math.min(last_row, to.row)), step: Math.max(0, Math.min(until, to.step)) } : from;
      pick(next);
      announce(sentence(matrix, next));
    } else if (event.key === "Enter" && cell) {
      event.preventDefault();
      watch(cell);
    } else if (event.key === "Escape" && cell) {
      pick(null);
    }
  };

  render() {
    const { matrix, pick, label, cell } = this.props;
    const { hover } = this.state;
    return <div class="race-map">
      <Canvas label={label} height={this.height} draw={this.draw} attributes={{
        role: "application", tabIndex: 0, "aria-roledescription": "race matrix", class: "pointed",
        "aria-describedby": "race-help",
        onMouseMove: (e: MouseEvent) => {
          const at = this.at(e);
          if (at?.row !== hover?.row || at?.step !== hover?.step) this.setState({ hover: at });
        },
        onMouseLeave: () => this.setState({ hover: null }),
        onClick: (e: MouseEvent) => pick(this.at(e)),
        onDblClick: (e: MouseEvent) => { const at = this.at(e); if (at) this.props.watch(at); },
        onKeyDown: this.key_down,
      }} />
      <p class="hover-line" aria-hidden="true">{hover ? sentence(matrix, hover) : cell ? sentence(matrix, cell) : "Point at a cell, or move with the arrows: its score, rank and seed stand here."}</p>
      <p id="race-help" class="unseen">Arrows move from cell to cell, with shift by ten; Home and End go to the first and last step, Page Up and Page Down to the best and last candidate; Enter watches the run.</p>
    </div>;
  }
}

/// A cell in words.
function sentence(matrix: Matrix, { row, step }: At): string {
  const { race } = matrix;
  const score = race.scores[step][row];
  const dropped = race.dropped_at[row];
  const what = score === null || score === undefined
    ? dropped !== null && dropped < race.steps[step] ? `dropped after step ${dropped}: ${race.reasons[row]}` : "not evaluated"
    : `score ${number(score, 6)}, rank ${number(matrix.rank[step][row])} of ${matrix.ranked[step]}`
      + (dropped === race.steps[step] ? `, dropped after it: ${race.reasons[row]}` : "");
  return `c${race.candidates[row]}, step ${race.steps[step]}, instance ${race.instances[step]}, seed ${race.seeds[step]}: ${what}`;
}

/// The evaluation's id as people type it.
export function evaluation_id(candidate: number, pair: number): string {
  return `e${candidate * 100000 + pair}`;
}

function Legend() {
  return <ul class="legend">
    <li><span class="swatch viridis" /> rank, best to worst</li>
    <li><span class="swatch dropped-end" /> dropped here</li>
    <li><span class="swatch gone" /> no longer in the race</li>
    <li><span class="swatch elite" /> elite before (left), after (right)</li>
  </ul>;
}

class RacePage extends Component<PageProps, { who: boolean }> {
  state = { who: false };
  private matrix: Matrix | null = null;

  private cell_of(matrix: Matrix, until: number): At | null {
    const found = /^c(\d+)(?:,(\d+))?$/.exec(this.props.query.cell ?? "");
    const row = found && matrix.known.get(Number(found[1]));
    if (!found || row === null || row === undefined) return null;
    const { steps, scores } = matrix.race;
    let step = found[2] ? steps.indexOf(Number(found[2])) : -1;
    // A candidate alone: its last cell.
    if (step < 0) for (step = until; step > 0 && (scores[step][row] ?? null) === null;) --step;
    return { row, step: Math.min(step, until) };
  }

  private show(campaign: Campaign, design: Design, race: Race) {
    if (race.steps.length === 0) return <Empty>No step of this race has ended yet.</Empty>;
    if (this.matrix?.race !== race) this.matrix = new Matrix(race);
    const matrix = this.matrix;
    const { c } = campaign;
    const last = race.steps.length - 1;
    const wanted = this.props.query.step ? race.steps.indexOf(Number(this.props.query.step)) : -1;
    const until = wanted < 0 ? last : wanted;
    const cell = this.cell_of(matrix, until);
    const d = design.id, store = shell_word(campaign.store);
    const pick = (at: At | null) => set_query({ cell: at ? `c${race.candidates[at.row]},${race.steps[at.step]}` : null });
    const watch = (at: At) => {
      if ((race.scores[at.step][at.row] ?? null) !== null) go(href([c, "runs", evaluation_id(race.candidates[at.row], race.pairs[at.step])]));
    };
    const now = race.steps[until];
    const fallen = race.candidates.filter((_, row) => matrix.dropped(row, now) !== null).length;
    return <div class="beside">
      <Panel title={`Race ${race.iteration}${race.ended ? "" : ", running"}: candidates by step`}
        command={`swarmsmith figure race ${store} --design ${d} --iteration ${race.iteration} -o race.svg`}
        sql={`SELECT * FROM v_race_matrix WHERE design = ${d.slice(1)} AND iteration = ${race.iteration}`}
        tools={<Files c={c} kind="race" name="race" options={{ design: d, iteration: race.iteration }} />}>
        <div class="slider"><label for="step">after step {now}{until === last && !race.ended ? ", the newest" : ""}</label>
          <input id="step" type="range" min={0} max={last} value={String(until)} aria-valuetext={`step ${now}, ${race.alive[until]} alive`}
            onInput={(e) => { const to = Number((e.target as HTMLInputElement).value); set_query({ step: to === last ? null : race.steps[to] }); }} />
          <span class="faint">{until < last ? `as it was then; ${count(last - until, "later step")} hidden` : `${count(last + 1, "step")}`}</span>
        </div>
        <RaceMap matrix={matrix} until={until} cell={cell} pick={pick} watch={watch}
          label={`Race ${race.iteration} of ${d}: ${race.candidates.length} candidates, best first, by ${count(until + 1, "step")}; ${fallen} dropped, ${race.alive[until]} alive. The table below has the same.`} />
        <Legend />
        {race.rows_total > race.candidates.length && <p class="faint">The best {whole(race.candidates.length)} of {whole(race.rows_total)} candidates. <button class="quiet" onClick={() => set_query({ rows: race.rows_total })}>Show all</button></p>}
      </Panel>
      <div class="side">
        <Panel title="Cell">{cell ? this.cell(campaign, matrix, cell, watch) : <Empty>Click a cell to see what made its score, and to watch the run.</Empty>}</Panel>
        <Panel title={`Step ${now}`}>{this.step(race, until)}</Panel>
      </div>
      <Panel wide title={`Candidates after step ${now}`}>{this.table(matrix, until)}</Panel>
    </div>;
  }

  private cell(campaign: Campaign, matrix: Matrix, at: At, watch: (at: At) => void) {
    const { race } = matrix;
    const { c } = campaign;
    const candidate = race.candidates[at.row];
    const score = race.scores[at.step][at.row] ?? null;
    const id = evaluation_id(candidate, race.pairs[at.step]);
    const dropped = race.dropped_at[at.row];
    return <div>
      <dl class="facts">
        <Fact name="candidate">{To("c", candidate)}</Fact>
        <Fact name="score" title="higher is better">{number(score, 6)}</Fact>
        <Fact name="rank">{number(matrix.rank[at.step][at.row])} <span class="small faint">of {matrix.ranked[at.step]}</span></Fact>
      </dl>
      <p>Step {race.steps[at.step]}, instance {race.instances[at.step]}, seed {race.seeds[at.step]}. {dropped !== null ? `Dropped after step ${dropped}: ${race.reasons[at.row]}.` : race.elite_after[at.row] ? "An elite after this race." : race.ended ? "It stayed to the end." : "It is alive."}</p>
      {score !== null ? <div>
        <p class="tools"><button class="main" onClick={() => watch(at)}>Watch this run</button>
          <Copy what="Copy as command" text={`swarmsmith explain ${id} ${shell_word(campaign.store)}`} /></p>
        <p><button aria-expanded={this.state.who} onClick={() => this.setState({ who: !this.state.who })}>Who made it</button></p>
        {this.state.who && <Get<Record<string, unknown>> path={`${c}/evaluations/${id}`} keep render={(answer) => <Explained answer={answer} />} />}
      </div> : <p class="faint">It was not evaluated here.</p>}
    </div>;
  }

  private step(race: Race, until: number) {
    const p = race.p_value[until], best = race.best[until];
    return <dl class="facts">
      <Fact name="test"><code>{race.markers[until]}</code> <span class="small">{kMarkers[race.markers[until]]}</span></Fact>
      <Fact name="p value">{p !== null && p < 0.0001 ? "< 0.0001" : number(p, 3)}</Fact>
      <Fact name="alive">{whole(race.alive[until])}</Fact>
      <Fact name="best">{best ? To("c", best) : "–"}</Fact>
      <Fact name="its mean">{number(race.mean_best[until])}</Fact>
    </dl>;
  }

  private table(matrix: Matrix, until: number) {
    const { race } = matrix;
    const now = race.steps[until];
    const rows = race.candidates.map((candidate, row) => {
      const dropped = matrix.dropped(row, now);
      return { candidate, row, ...matrix.mean(row, until), dropped, reason: dropped === null ? null : race.reasons[row],
        elite: race.elite_before[row] ? "before" + (race.elite_after[row] ? " and after" : "") : race.elite_after[row] ? "after" : "" };
    });
    return <Table<typeof rows[0]> name="r" caption={`Candidates after step ${now}`} rows={rows} page_size={25}
      columns={[
        { key: "candidate" },
        { key: "mean", label: "mean score here", title: "over the pairs of this race; higher is better" },
        { key: "n", label: "pairs" },
        { key: "dropped", label: "dropped after step" },
        { key: "reason", label: "why" },
        { key: "elite" },
        { key: "cell", show: (row) => <button class="quiet" onClick={() => set_query({ cell: "c" + row.candidate })}>show</button> },
      ]} />;
  }

  render() {
    const { params, query } = this.props;
    const found = find_design(this.props);
    if (!found) return <NoDesign c={params.c} d={params.d} />;
    const { campaign, design } = found;
    const { c } = campaign;
    const newest = Math.max(1, design.iteration);
    const iteration = params.iteration ? Number(params.iteration) : null;
    const shown = iteration ?? newest;
    const moves = shown === design.iteration;
    const to = (n: number) => go(href([c, design.id, "race", String(n)]));
    return <div>
      <DesignTitle c={c} design={design} />
      <div class="slider"><label for="iteration">iteration {shown}{shown > newest ? `; the newest is ${newest}` : ` of ${newest}`}</label>
        <button class="quiet" aria-label="iteration before" disabled={shown <= 1} onClick={() => to(shown - 1)}>‹</button>
        <input id="iteration" type="range" min={1} max={newest} value={String(shown)} disabled={newest < 2} onInput={(e) => to(Number((e.target as HTMLInputElement).value))} />
        <button class="quiet" aria-label="iteration after" disabled={shown >= newest} onClick={() => to(shown + 1)}>›</button>
        {iteration !== null && iteration !== newest || iteration !== null && design.state === "racing" ? <a href={href([c, design.id, "race"])}>the newest</a> : null}
      </div>
      {design.iteration === 0 ? <Empty>{design.state === "finished" ? "No race: this method takes what it is given, or what it draws."
        : "No step of the race has ended yet: its cells come one by one."}</Empty>
        : <Get<Race> path={path_of(`${c}/designs/${design.id}/race`, { iteration: shown, rows: query.rows && Number(query.rows) !== kRows ? query.rows : null })} keep
          version={moves ? design.version : "ended"} render={(race) => this.show(campaign, design, race)} missing={(error) => <Empty>{error.message}</Empty>} />}
    </div>;
  }
}

/// What `explain` says, name by name.
function Explained({ answer }: { answer: Record<string, unknown> }) {
  return <dl class="pairs">{Object.entries(answer).filter(([name, value]) => name !== "v" && value !== null && said(value) !== "")
    .map(([name, value]) => <div><dt>{name.replace(/_/g, " ")}</dt><dd>{said(value)}</dd></div>)}</dl>;
}

export const race: Page = {
  pattern: ":c/:d/race/:iteration?", title: ({ d, iteration }) => `Race ${iteration ?? ""} of ${d}`, view: RacePage,
  nav: { label: "Race", letter: "r", path: ({ c, d }) => d ? [c, d, "race"] : null },
  keys: [{ key: "← → ↑ ↓", what: "move the cell in the matrix" }, { key: "Enter", what: "watch the run of the cell" }, { key: "Esc", what: "leave the cell" }],
};
