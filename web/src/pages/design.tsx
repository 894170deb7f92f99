import { Component, h } from "preact";
import { post } from "../api";
import { Bar, command, Confirm, Copy, Empty, link, pairs, Panel, place_of, state_word, Table, typed, used_of } from "../components";
import { Machine } from "../figure";
import { count, number, whole, words } from "../format";
import { Get } from "../get";
import { PageProps } from "../page";
import { Columns, Design, DesignAnswer, Row } from "../types";
import { convergence, is_over, kPause, stage_of } from "./campaigns";

export function design_title(design: Design) {
  return <h1>{link(design.id)} <small>{words(design.mission)} · {design.method} · repetition {design.repetition}</small> {state_word(design)}</h1>;
}

export const kNoRace = "No race: this method uses given or randomly drawn candidates.";

/// The commands for a design, each with a confirmation.
class Acts extends Component<{ c: string; design: Design }, { more: string }> {
  state = { more: "1000" };
  render({ c, design }: { c: string; design: Design }, { more }: { more: string }) {
    const { id, paused, budget } = design;
    const act = (what: string, effect: any, { path = what.toLowerCase(), of = what, danger = false, is_offered = true } = {}) =>
      <Confirm label={what} danger={danger} is_offered={is_offered} title={`${of} ${id}?`} act={() => post(`${c}/designs/${id}/${path}`)}>{effect}</Confirm>;
    const open = !is_over(design);
    return <div class="tools">
      {act("Resume", "It will get work again.", { is_offered: open && !!paused })}
      {act("Pause", kPause, { is_offered: open && !paused })}
      {act("Extend", [<label>More experiments: <input type="number" min="1" step="1" value={more} onInput={(event) => this.setState({ more: typed(event) })} /></label>,
        <p>From {whole(budget)} to {whole(budget + (Number(more) || 0))}. This cannot be undone. The store keeps the command, so that the campaign gives the same answer again.</p>],
        { path: `extend?budget=${Number(more)}`, of: "Extend the budget of" })}
      {act("Cancel", "Its race ends after the current step, and the best so far is its winner. This cannot be undone.", { danger: true, is_offered: open })}
    </div>;
  }
}

/// The rows of an answer that is given in columns.
export function rows_of(columns: Columns): Row[] {
  const lists = Object.entries(columns).filter(([, list]) => Array.isArray(list));
  return (lists[0]?.[1] ?? []).map((_, i) => Object.fromEntries(lists.map(([name, list]) => [name, list[i]])));
}

function iterations_table(c: string, { id, version }: Design, { iterations, elites }: DesignAnswer) {
  return <Get<Columns> path={`${c}/designs/${id}/steps`} version={version} grows="step" render={(columns) => {
    const steps = rows_of(columns);
    const rows = iterations.map((one) => {
      const own = steps.filter((step) => step.iteration === one.iteration);
      const best = elites.find((elite) => elite.iteration === one.iteration && elite.rank === 1);
      return { ...one, best: best?.candidate, mean: best?.mean, steps: own.length, alive: own[own.length - 1]?.alive_after,
        used: own.reduce((sum, step) => sum + Number(step.evaluated), 0), markers: own.map((step) => step.marker).join("") };
    });
    return <Table name="i" caption="Iterations" sort="-iteration" rows={rows} empty="It has not begun." columns={[
      { key: "iteration", show: ({ iteration, round }) => <a href={`${place_of(id)}/race/${iteration}`}>{round ?? iteration}</a> },
      { key: "configurations", label: "candidates", title: "including the elites of the previous iteration" },
      "steps",
      { key: "used", label: "experiments" },
      { key: "alive", label: "alive at the end" },
      { key: "mean", label: "best mean" },
      "best",
      { key: "markers", label: "tests", title: "one letter per step: x no test, - some dropped, = none dropped, ! would drop elites, . none had to run",
        show: (one) => <code class="markers">{one.markers}</code> }]} />;
  }} />;
}

function shown(c: string, design: Design, answer: DesignAnswer) {
  const { design: row, iterations, elites, machine, tests, commands } = answer;
  const { id, best, stage, alive } = design;
  const last = Math.max(0, ...elites.map((one) => one.iteration));
  const elites_title = last > 0 ? `Elites after iteration ${last}` : "Elites";
  const over = is_over(design);
  return <div>
    {pairs("panel facts", [
      ["experiments", [<Bar of={design} name="experiments used" />, used_of(design)]],
      [stage ? "search" : "iteration", [stage ?? whole(design.iteration), !over && alive !== null && <small> {whole(alive)} alive</small>]],
      ["best", best ? link(best) : "none yet"],
      ["mean in the race", number(design.best_mean), "over the pairs on which the best has run; it was chosen by this mean; higher is better"],
      ["mean in tests on fresh seeds", tests ? [number(tests.mean), " ", <small>{number(tests.low)} to {number(tests.high)}, {count(tests.n, "run")}</small>]
        : <small>{over ? "none" : "after the race"}</small>, "mean and its 95 % interval"],
      row.reason && ["why it ended", <span class="small">{row.reason}</span>]])}
    <div class="grid">
      <Panel title="Convergence: mean score of the best, band of the elites" command={command("figure convergence", `--design ${id} -o convergence.svg`)}>
        {convergence(c, [design], id)}</Panel>
      <Panel title={best ? `${over ? "The winner" : "Best so far"}: ${best}` : "Best so far"}
        command={best ? command(`show ${best}`) : ""} tools={machine && <Copy what="Copy its text" text={machine.text} />}>
        {!best ? <Empty>None yet: there is one after the first step.</Empty>
          : machine && !machine.flavour ? <Empty>A configuration of a program: its parameters are below.</Empty> : <Machine of={best} />}
        {machine?.text && <details open={!machine.flavour}><summary>Its text</summary><pre>{machine.text}</pre></details>}
      </Panel>
      <Panel wide title="Iterations, newest first">
        {iterations.length || !over ? iterations_table(c, design, answer) : <Empty>{kNoRace}</Empty>}
      </Panel>
      <Panel title={elites_title}>
        <Table name="el" caption={elites_title} rows={elites.filter(({ iteration }) => iteration === last)}
          empty={over ? "None." : "No iteration has ended yet: there are elites after the first."} columns={[
            "rank", "candidate",
            { key: "mean", label: "mean score", title: "higher is better" },
            { key: "n", label: "pairs", title: "(instance, seed) on which it has run" }]} /></Panel>
      <Panel title="Commands that people gave">
        <Table name="co" caption="Commands" rows={commands} row_key={(one) => one.number}
          empty="None." columns={[
            { key: "at", label: "when" }, { key: "kind", label: "command" }, "who",
            { key: "budget", label: "experiments" }, { key: "step", label: "after step" }]} /></Panel>
    </div>
  </div>;
}

export function DesignPage({ params: { c }, campaign, design }: PageProps) {
  return <div>
    <div class="panel-head">{design_title(design)}{campaign.may_act && <Acts c={c} design={design} />}</div>
    {!design.iteration && design.state === "waiting" && <Empty>It waits for its turn: it has no evaluations yet ({stage_of(design)}).</Empty>}
    <Get<DesignAnswer> path={`${c}/designs/${design.id}`} keep version={`${design.version} ${design.state} ${design.paused}`} render={(answer) => shown(c, design, answer)} />
  </div>;
}
