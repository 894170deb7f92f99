import { Component, h } from "preact";
import { post } from "../api";
import { Bar, Confirm, Copy, Empty, Fact, Panel, StateWord, Table } from "../components";
import { Figure } from "../figure";
import { count, number, percent, shell_word, whole, words } from "../format";
import { Get } from "../get";
import { Page, PageProps } from "../page";
import { href } from "../route";
import { Campaign, Columns, Design, DesignAnswer, Elite, Iteration } from "../types";
import { Convergence, stage_of } from "./campaigns";

/// The parts of an address that a view of a design needs.
export function find_design(props: PageProps): { campaign: Campaign; design: Design } | null {
  const campaign = props.live.campaigns.find((one) => one.c === props.params.c);
  const design = campaign?.designs.find((one) => one.id === props.params.d);
  return campaign && design ? { campaign, design } : null;
}

export function NoDesign({ c, d }: { c: string; d: string }) {
  return <Empty>There is no design {d} in {c}. <a href="#/">All campaigns</a> shows those that are there.</Empty>;
}

export function DesignTitle({ c, design }: { c: string; design: Design }) {
  return <h1><a href={href([c, design.id])}>{design.id}</a> <span class="light">{words(design.mission)} · {design.method} · repetition {design.repetition}</span> <StateWord state={design.state} paused={design.paused} /></h1>;
}

/// What may be done to a design, each after a question.
class Acts extends Component<{ c: string; design: Design }, { budget: string }> {
  state = { budget: "1000" };
  render() {
    const { c, design } = this.props;
    const act = (what: string) => async () => (await post(`${c}/designs/${design.id}/${what}`)).done;
    const over = design.state === "finished" || design.state === "stopped";
    const budget = Number(this.state.budget);
    return <div class="tools">
      {!over && !design.paused && <Confirm label="Pause" title={`Pause ${design.id}?`} act={act("pause")}>
        Evaluations that run now end and count; nothing more of it is given out until somebody resumes it.</Confirm>}
      {!over && design.paused && <Confirm label="Resume" title={`Resume ${design.id}?`} act={act("resume")}>It will get work again.</Confirm>}
      {<Confirm label="Extend" title={`Extend the budget of ${design.id}?`} act={act(`extend?budget=${budget}`)}>
        <label>Experiments more: <input type="number" min="1" step="1" value={this.state.budget}
          onInput={(e) => this.setState({ budget: (e.target as HTMLInputElement).value })} /></label>
        <p>From {whole(design.budget)} to {whole(design.budget + (budget || 0))}. This cannot be taken back; the command is kept in the store, so that the same answer comes out again.</p></Confirm>}
      {!over && <Confirm label="Cancel" danger title={`Cancel ${design.id}?`} act={act("cancel")}>
        Its race ends after the step that runs, and the best so far is its winner. This cannot be taken back.</Confirm>}
    </div>;
  }
}

/// The rows of an answer in columns.
export function rows_of(columns: Columns): Record<string, string | number | null>[] {
  const names = Object.keys(columns).filter((name) => Array.isArray(columns[name]));
  const length = names.length ? columns[names[0]].length : 0;
  return Array.from({ length }, (_, i) => Object.fromEntries(names.map((name) => [name, columns[name][i]])));
}

class Iterations extends Component<{ c: string; design: Design; iterations: Iteration[]; elites: Elite[] }, {}> {
  render() {
    const { c, design, iterations, elites } = this.props;
    return <Get<Columns> path={`${c}/designs/${design.id}/steps`} version={design.version} render={(columns) => {
      const steps = rows_of(columns);
      const rows = iterations.map((iteration) => {
        const own = steps.filter((step) => step.iteration === iteration.iteration);
        const best = elites.find((elite) => elite.iteration === iteration.iteration && elite.rank === 1);
        return { ...iteration, best: best?.candidate, mean: best?.mean, steps: own.length,
          alive: own[own.length - 1]?.alive_after,
          used: own.reduce((sum, step) => sum + Number(step.evaluated), 0),
          markers: own.map((step) => step.marker).join("") };
      });
      return <Table<typeof rows[0]> name="i" caption="Iterations" sort="-iteration" rows={rows} page_size={20}
        empty="The race has not begun."
        columns={[
          { key: "iteration", show: (row) => <a href={href([c, design.id, "race", String(row.iteration)])}>{row.postselection ? `${row.iteration}, last race` : String(row.iteration)}</a> },
          { key: "configurations", label: "candidates", title: "with the elites of the iteration before" },
          { key: "steps" },
          { key: "used", label: "experiments" },
          { key: "alive", label: "alive at the end" },
          { key: "mean", label: "best mean" },
          { key: "best" },
          { key: "markers", label: "tests", title: "a letter a step: x no test, - some dropped, = nobody dropped, ! would drop elites, . nobody had to run",
            show: (row) => <code class="markers">{row.markers}</code> },
        ]} />;
    }} />;
  }
}

class DesignPage extends Component<PageProps, {}> {
  private answer(campaign: Campaign, design: Design, answer: DesignAnswer) {
    const { c } = campaign;
    const { design: row, iterations, elites, machine, tests, commands } = answer;
    const last = Math.max(0, ...elites.map((elite) => elite.iteration));
    const store = shell_word(campaign.store);
    const over = design.state === "finished" || design.state === "stopped";
    return <div>
      <dl class="facts framed">
        <Fact name="experiments"><Bar value={design.used} of={design.budget} name="experiments used" />{whole(design.used)} <span class="small faint">of {whole(design.budget)}, {percent(design.budget > 0 ? design.used / design.budget : 0)}</span></Fact>
        <Fact name={design.stage ? "search" : "iteration"}>{design.stage ?? whole(design.iteration)}{!over && design.alive !== null && <span class="small faint"> {whole(design.alive)} alive</span>}</Fact>
        <Fact name="best">{design.best ? <a href={href([c, design.best])}>{design.best}</a> : "none yet"}</Fact>
        <Fact name="mean in the race" title="over the pairs that the best has met; higher is better">{number(design.best_mean)}</Fact>
        <Fact name="tests on fresh seeds" title="mean and its 95 % interval">{tests ? <span>{number(tests.mean)} <span class="small faint">{number(tests.low)} to {number(tests.high)}, {count(tests.n, "run")}</span></span> : <span class="small faint">{over ? "none" : "after the race"}</span>}</Fact>
        {row.reason && <Fact name="why it ended"><span class="small">{row.reason}</span></Fact>}
      </dl>
      <div class="grid">
        <Panel title="Convergence: mean score of the best, band of the elites" command={`swarmsmith figure convergence ${store} --design ${design.id} -o convergence.svg`}>
          <Convergence c={c} designs={[design]} design={design.id} version={design.version} /></Panel>
        <Panel title={design.best ? `${over ? "The winner" : "Best so far"}: ${design.best}` : "Best so far"}
          command={design.best ? `swarmsmith show ${design.best} ${store}` : ""} tools={machine && <Copy what="Copy its text" text={machine.text} />}>
          {!design.best ? <Empty>None yet: it comes with the end of the first step.</Empty>
            : machine && !machine.flavour ? <Empty>A configuration of a program: its words are below.</Empty>
            : <Figure c={c} kind="machine" options={{ candidate: design.best }} name={`Drawing of ${design.best}`} missing={(error) => <Empty>{error.message}</Empty>} />}
          {machine?.text && <details open={!machine.flavour}><summary>Its text</summary><pre>{machine.text}</pre></details>}
        </Panel>
        <Panel wide title="Iterations, newest first">
          {iterations.length === 0 && (over || design.stage)
            ? <Empty>{design.stage ? `This method does not race: it is at ${design.stage}.` : "No race: this method takes what it is given, or what it draws."}</Empty>
            : <Iterations c={c} design={design} iterations={iterations} elites={elites} />}
        </Panel>
        <Panel title={last > 0 ? `Elites after iteration ${last}` : "Elites"}>
          <Table<Elite> name="el" page_size={10} caption={`Elites after iteration ${last}`} rows={elites.filter((elite) => elite.iteration === last)} 
            empty="No iteration has ended yet: elites come after the first."
            columns={[
              { key: "rank" },
              { key: "candidate" },
              { key: "mean", label: "mean score", title: "higher is better" },
              { key: "n", label: "pairs", title: "(instance, seed) that it has met" },
            ]} /></Panel>
        <Panel title="Commands that people gave">
          <Table<DesignAnswer["commands"][0]> name="co" caption="Commands" rows={commands} row_key={(row) => String(row.number)}
            empty="None: nobody paused, resumed, extended or cancelled it."
            columns={[
              { key: "at", label: "when" },
              { key: "kind", label: "command" },
              { key: "who" },
              { key: "budget", label: "experiments" },
              { key: "step", label: "after step" },
            ]} /></Panel>
      </div>
    </div>;
  }

  render() {
    const { params, live } = this.props;
    const found = find_design(this.props);
    if (!found) return <NoDesign c={params.c} d={params.d} />;
    const { campaign, design } = found;
    return <div>
      <div class="panel-head"><DesignTitle c={campaign.c} design={design} />{live.may_act && <Acts c={campaign.c} design={design} />}</div>
      {!design.iteration && design.state === "waiting" && <Empty>It waits for its turn: nothing of it has been evaluated ({stage_of(design)}).</Empty>}
      <Get<DesignAnswer> path={`${campaign.c}/designs/${design.id}`} keep version={`${design.version} ${design.state} ${design.paused}`} render={(answer) => this.answer(campaign, design, answer)} />
    </div>;
  }
}

export const design: Page = {
  pattern: ":c/:d", title: ({ d }) => `Design ${d}`, view: DesignPage,
  nav: { label: "Design", letter: "d", path: ({ c, d }) => d ? [c, d] : null },
};
