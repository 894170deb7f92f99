import { h } from "preact";
import { post } from "../api";
import { Bar, command, Confirm, Empty, pairs, Panel, state_word, store_word, Table, used_of } from "../components";
import { Figure } from "../figure";
import { count, in_order, is_known, number, whole, words } from "../format";
import { Get } from "../get";
import { PageProps } from "../page";
import { href } from "../route";
import { eta_of, look_list } from "../shell";
import { Campaign, Design, Event, Live } from "../types";

export const kPause = "Running evaluations finish and count; no new ones start until you resume. Nothing is lost.";

/// Whether the design has ended.
export function is_over({ state }: Design): boolean { return state === "finished" || state === "stopped"; }

/// "iteration 4", or the stage in the words of another search; empty before it begins.
export function stage_of({ stage, iteration }: Design): string {
  return stage ?? (iteration > 0 ? `iteration ${iteration}` : "not begun");
}

/// The best mean: from the tests if there are any, because the race's own pairs selected the best
/// candidate; before the tests, from the race.
export function told_mean({ test_mean, best_mean }: Design): number | null { return test_mean ?? best_mean; }

/// The origin of that mean.
export function mean_of({ test_runs, best_mean }: Design): string {
  return test_runs > 0 ? "tested" : best_mean === null ? "" : "in race";
}

function card(c: string, design: Design, leads: boolean) {
  const { id, method, repetition, state, alive, campaign } = design;
  return <a key={id} class={leads ? "card leads" : "card"} href={href([c, id])}
    aria-label={`${id}, ${words(design.mission)}, ${method}, repetition ${repetition}${campaign ? `, of ${campaign}` : ""}: ${design.paused ? "paused" : state}`}>
    <span class="card-head"><b>{id}</b>{state_word(design)}</span>
    <Bar of={design} name={`${id}: experiments used`} />
    <span><b>{number(told_mean(design))}</b> <small>{mean_of(design)}{leads && ", best"}</small></span>
    {campaign && <small>{campaign}</small>}
    <small>{is_over(design) ? `${whole(design.used)} used` : stage_of(design)}{state === "racing" && alive !== null && `, ${whole(alive)} alive`}</small>
  </a>;
}

function grid({ c, designs }: Campaign) {
  // If their rows are short, missions are side by side.
  const wide = designs.some((one) => one.repetition > 3);
  return <div class={wide ? "" : "missions"}>{in_order(designs.map((one) => one.mission)).map((mission) => {
    const here = designs.filter((one) => one.mission === mission);
    // Scores of different missions have different units. A race's mean is too optimistic to be
    // compared with a test mean.
    const tested = here.filter((one) => one.test_runs > 0);
    const compared = tested.length > 0 ? tested : here;
    const best = Math.max(...compared.map((one) => told_mean(one) ?? -Infinity));
    return <div class="mission">
      <h3>{words(mission)} <small>mean score of the best so far, from its tests if it has any; higher is better</small></h3>
      {in_order(here.map((one) => one.method)).map((method) => <div class="method">
        <div class="method-name">{method}</div>
        <div class="cards">{here.filter((one) => one.method === method).sort((a, b) => a.repetition - b.repetition)
          .map((one) => card(c, one, compared.length > 1 && compared.includes(one) && told_mean(one) === best))}</div>
      </div>)}
    </div>;
  })}</div>;
}

/// A value of an event, formatted for people.
export function said(value: unknown): string {
  if (typeof value === "number") return number(value, 6);
  if (!is_known(value) || typeof value !== "object") return String(value ?? "");
  return Object.entries(value as Record<string, unknown>).filter(([name, part]) => part !== null && part !== "" && name !== "at")
    .map(([name, part]) => Array.isArray(value) ? said(part) : `${words(name)} ${said(part)}`).join(", ");
}

function events({ c, last_event }: Campaign) {
  return <Get<{ events: Event[] }> path={`${c}/events`} version={last_event} render={(one) =>
    <Table name={"e" + c} caption="Events, newest first" rows={one.events} page_size={12}
      row_key={({ kind, seq, at }) => `${kind}-${seq}-${at}`}
      row_class={(event) => event.severity === "error" && "bad"}
      empty="No failures, commands or conflicts. Progress is not an event."
      columns={[{ key: "at", label: "when" }, "severity", { key: "kind", label: "what", value: (one) => words(one.kind) },
        { key: "data", label: "details", value: (one) => said(one.data) }]} />} />;
}

/// The convergence of a campaign or of a design. It begins at the end of the first iteration.
export function convergence(c: string, designs: Design[], design?: string) {
  const none = <Empty>{designs.every(is_over) ? "None." : "No iteration has ended yet: convergence is shown after the first."}</Empty>;
  return designs.some(({ state, iteration }) => iteration > (state === "racing" || state === "interrupted" ? 1 : 0))
    ? <Figure c={c} kind="convergence" options={{ design }} name="Convergence" version={version_of(designs)} missing={none} /> : none;
}

/// Changes when an iteration or a design ends; between these events, winners and elites do not
/// change.
export function version_of(designs: Design[]): string {
  return designs.map(({ iteration, state }) => iteration + state).join();
}

function campaign_panels(live: Live, campaign: Campaign) {
  const { c, name, designs, state, store } = campaign;
  const states = ["finished", "racing", "testing", "waiting", "interrupted", "stopped"].map((word) => [word, designs.filter((one) => one.state === word).length])
    .filter(([, n]) => n).map(([word, n]) => `${n} ${word}`).join(", ");
  const paused = designs.filter((one) => one.paused).length;
  const run = <code>swarmsmith run CAMPAIGN.toml --store {store_word(campaign)}</code>;
  const confirm = (what: string, effect: string, is_offered: boolean) =>
    <Confirm label={`${what} all`} is_offered={is_offered} title={`${what} all designs of ${name}?`} act={() => post(`${c}/${what.toLowerCase()}`)}>{effect}</Confirm>;
  return <div class="grid">
    <Panel title={name} wide command={command("ls", "", campaign)} tools={campaign.may_act && [
      confirm("Pause", kPause, paused < designs.length && !designs.every(is_over)),
      confirm("Resume", `${count(paused, "paused design")} will get work again.`, paused > 0)]}>
      {pairs("facts", [
        ["state", state_word({ state, paused: paused > 0 && paused === designs.length })],
        ["designs", [whole(designs.length), " ", <small>{states}{paused > 0 && `, ${paused} paused`}</small>]],
        ["experiments", used_of(campaign)],
        state === "running" && live.running && ["ETA", eta_of(live, campaign.eta_s), "the rest of the budgets at the rate of the last minute"],
        ["store", <span class="small">{store}</span>],
        ["campaign's digest", <code class="small">{campaign.digest.slice(0, 12) || "–"}</code>, "of everything that decides the answer; swarmsmith digest prints that of the answer"]])}
      {state === "interrupted" && <Empty>It is not finished, but no process works on it here. {run} continues it.</Empty>}
      {designs.length ? grid(campaign)
        : <Empty>This store has no design yet. {run} starts them; <code>swarmsmith import</code> adds results from elsewhere.</Empty>}
    </Panel>
    {designs.length > 0 && <Panel title="Convergence: mean score of the best, over experiments used">{convergence(c, designs)}</Panel>}
    <Panel title="Events, newest first">{events(campaign)}</Panel>
  </div>;
}

export function Campaigns({ live, campaign }: PageProps) {
  const { campaigns, looks } = live;
  return <div>
    <h1>{campaigns.length === 1 ? "Campaign" : "Campaigns"}</h1>
    {looks.length > 0 && <Panel title="Needs a look">{look_list(looks, 8)}</Panel>}
    {campaigns.length === 0 && <Empty>No store is open.</Empty>}
    {(campaign ? [campaign] : campaigns).map((one) => campaign_panels(live, one))}
  </div>;
}
