import { Component, h } from "preact";
import { post } from "../api";
import { Bar, Confirm, Empty, Fact, Panel, StateWord, Table } from "../components";
import { Figure } from "../figure";
import { count, number, percent, shell_word, whole, words } from "../format";
import { Get } from "../get";
import { Page, PageProps } from "../page";
import { href } from "../route";
import { eta_of, looks } from "../shell";
import { Campaign, Design, Event, Live } from "../types";

/// "iteration 4", or how another search says where it is; nothing before it begins.
export function stage_of(design: Design): string {
  if (design.stage) return design.stage;
  return design.iteration > 0 ? `iteration ${design.iteration}` : "not begun";
}

/// Numbers in the order of people: 3 before 20.
function in_order(names: Iterable<string>): string[] {
  return [...new Set(names)].sort((a, b) => a.localeCompare(b, "en", { numeric: true }));
}

/// The design with the best mean of a mission, among those that have one: scores of missions differ
/// in their units.
function best_of(designs: Design[]): Design | null {
  return designs.reduce<Design | null>((best, one) =>
    one.best_mean !== null && (best === null || one.best_mean > best.best_mean!) ? one : best, null);
}

function Card({ c, design, leads }: { c: string; design: Design; leads: boolean }) {
  return <a class={leads ? "card leads" : "card"} href={href([c, design.id])}
    aria-label={`${design.id}, ${words(design.mission)}, ${design.method}, repetition ${design.repetition}: ${design.paused ? "paused" : design.state}`}>
    <span class="card-head"><b>{design.id}</b><StateWord state={design.state} paused={design.paused} /></span>
    <Bar value={design.used} of={design.budget} name={`${design.id}: experiments used`} />
    <span class="card-best"><b>{number(design.best_mean)}</b>{leads && <span class="faint"> best</span>}</span>
    <span class="faint small">{design.state === "finished" || design.state === "stopped" ? `${whole(design.used)} used` : stage_of(design)}
      {design.state === "racing" && design.alive !== null && `, ${whole(design.alive)} alive`}</span>
  </a>;
}

function Grid({ campaign }: { campaign: Campaign }) {
  const { designs, c } = campaign;
  // Missions stand beside each other where their rows are short.
  const wide = Math.max(...designs.map((one) => one.repetition)) > 3;
  return <div class={wide ? "" : "missions"}>{in_order(designs.map((one) => one.mission)).map((mission) => {
    const here = designs.filter((one) => one.mission === mission);
    const leader = here.length > 1 ? best_of(here) : null;
    return <div class="mission">
      <h3>{words(mission)} <span class="faint small">mean score of the best so far; higher is better</span></h3>
      {in_order(here.map((one) => one.method)).map((method) => <div class="method">
        <div class="method-name">{method}</div>
        <div class="cards">{here.filter((one) => one.method === method).sort((a, b) => a.repetition - b.repetition)
          .map((one) => <Card key={one.id} c={c} design={one} leads={leader !== null && one.best_mean === leader.best_mean} />)}</div>
      </div>)}
    </div>;
  })}</div>;
}

/// A value of an event as a person reads it.
export function said(value: unknown): string {
  if (value === null || value === undefined || value === "") return "";
  if (typeof value === "number") return number(value, 6);
  if (typeof value !== "object") return String(value);
  return Object.entries(value as Record<string, unknown>).filter(([name, part]) => part !== null && part !== "" && name !== "at")
    .map(([name, part]) => Array.isArray(value) ? said(part) : `${words(name)} ${said(part)}`).join(", ");
}

export class Events extends Component<{ c: string; version: number }, {}> {
  render() {
    const { c, version } = this.props;
    return <Get<{ events: Event[] }> path={`${c}/events`} version={version} render={({ events }) =>
      <Table<Event> name={"e" + c} caption="Events, newest first" rows={events} page_size={12}
        row_key={(event) => `${event.kind}-${event.seq}-${event.at}`}
        row_class={(event) => event.severity === "error" ? "bad" : ""}
        empty="Nothing has happened that people should know of: no failure, no command, no conflict. Progress is not an event."
        columns={[
          { key: "at", label: "when" },
          { key: "severity" },
          { key: "kind", label: "what", value: (e) => words(e.kind) },
          { key: "data", label: "details", value: (e) => said(e.data) },
        ]} />} />;
  }
}

/// Of a campaign or of a design. It begins with the end of an iteration.
export function Convergence({ c, designs, design, version }: { c: string; designs: Design[]; design?: string; version: number | string }) {
  const none = <Empty>No iteration has ended yet: convergence comes after the first.</Empty>;
  return designs.some((one) => one.iteration > (one.state === "racing" || one.state === "interrupted" ? 1 : 0))
    ? <Figure c={c} kind="convergence" options={{ design }} name="Convergence" version={version} missing={() => none} /> : none;
}

/// Moves when any design of it does.
export function version_of(campaign: Campaign): number {
  return campaign.designs.reduce((sum, one) => sum + one.version + (one.state === "finished" ? 1 : 0), 0);
}

class Campaigns extends Component<PageProps, {}> {
  private one(live: Live, campaign: Campaign) {
    const { c, designs } = campaign;
    const of = (state: string) => designs.filter((one) => one.state === state).length;
    const states = ["finished", "racing", "testing", "waiting", "interrupted", "stopped"].filter((state) => of(state) > 0)
      .map((state) => `${whole(of(state))} ${state}`).join(", ");
    const paused = designs.filter((one) => one.paused).length;
    const open = designs.some((one) => one.state !== "finished" && one.state !== "stopped");
    const act = async (what: string) => (await post(`${c}/${what}`)).done;
    return <div class="grid">
      <Panel title={campaign.name} wide tools={[
        live.may_act && open && paused < designs.length && <Confirm label="Pause all" title={`Pause all designs of ${campaign.name}?`} act={() => act("pause")}>
          Evaluations that run now end and count; nothing more is given out until somebody resumes. Nothing is lost.</Confirm>,
        live.may_act && paused > 0 && <Confirm label="Resume all" title={`Resume all designs of ${campaign.name}?`} act={() => act("resume")}>
          {count(paused, "paused design")} will get work again.</Confirm>]} command={`swarmsmith ls ${shell_word(campaign.store)}`}>
        <dl class="facts">
          <Fact name="state"><StateWord state={campaign.state} paused={paused > 0 && paused === designs.length} /></Fact>
          <Fact name="designs" title={states}>{whole(designs.length)} <span class="small faint">{states}{paused > 0 && `, ${paused} paused`}</span></Fact>
          <Fact name="experiments">{whole(campaign.used)} <span class="small faint">of {whole(campaign.budget)}, {percent(campaign.budget > 0 ? campaign.used / campaign.budget : 0)}</span></Fact>
          {campaign.state === "running" && live.running && <Fact name="ETA" title="the rest of the budgets at the rate of the last minute">{eta_of(live, campaign.eta_s)}</Fact>}
          <Fact name="store"><span class="small">{campaign.store}</span></Fact>
          <Fact name="digest" title="of all that decides the answer"><code class="small">{campaign.digest.slice(0, 12) || "–"}</code></Fact>
        </dl>
        {campaign.state === "interrupted" && <Empty>It is not finished, and no process works on it here. <code>swarmsmith run CAMPAIGN.toml --store {campaign.store}</code> continues it.</Empty>}
        {designs.length === 0
          ? <Empty>This store holds no design yet. <code>swarmsmith run CAMPAIGN.toml --store {campaign.store}</code> begins them, <code>swarmsmith import</code> brings results from elsewhere.</Empty>
          : <Grid campaign={campaign} />}
      </Panel>
      {designs.length > 0 && <Panel title="Convergence: mean score of the best, over experiments used">
        <Convergence c={c} designs={designs} version={version_of(campaign)} /></Panel>}
      <Panel title="Events, newest first"><Events c={c} version={campaign.last_event} /></Panel>
    </div>;
  }

  render() {
    const { live, params } = this.props;
    const shown = params.c ? live.campaigns.filter((one) => one.c === params.c) : live.campaigns;
    const found = looks(live);
    return <div>
      <h1>{live.campaigns.length === 1 ? "Campaign" : "Campaigns"}</h1>
      {found.length > 0 && <Panel title="Needs a look"><ul class="look">{found.slice(0, 8).map((look) =>
        <li><a href={look.address}>{look.text}</a></li>)}{found.length > 8 && <li class="faint">and {found.length - 8} more</li>}</ul></Panel>}
      {shown.length === 0 && <Empty>{params.c ? <span>There is no campaign {params.c} here. <a href="#/">All campaigns</a></span> : "No store is open."}</Empty>}
      {shown.map((campaign) => this.one(live, campaign))}
    </div>;
  }
}

export const campaigns: Page = {
  pattern: ":c?", title: ({ c }) => c ? `Campaign ${c}` : "Campaigns", view: Campaigns,
  nav: { label: "Campaigns", letter: "o", path: () => [] },
};
