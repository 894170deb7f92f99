import { h } from "preact";
import { Canvas, Pen } from "../canvas";
import { command, Empty, pairs, Panel, state_word, store_word, Table } from "../components";
import { count, duration, number, percent, when, whole, words } from "../format";
import { Get } from "../get";
import { PageProps } from "../page";
import { History, Quarantine, SlotTimes, Status, Worker } from "../types";

/// Why slots are idle, and what the user can do.
interface Cause { name: string; why: string; todo: string }

/// Colours for busy time and for each cause.
const kColors: Record<string, string> = { busy: "#0072b2", "start-up": "#56b4e9", barrier: "#e69f00", credit: "#cc79a7", alone: "#999",
  commit: "#d55e00", held: "#f0e442", network: "#009e73" };

function slot_time({ slot_times: all, slot_times_last_minute: minute }: Status, causes: Cause[]) {
  const seconds = ({ busy_s, idle_s }: SlotTimes, name: string) => name === "busy" ? busy_s : idle_s[name] ?? 0;
  const part = (times: SlotTimes, name: string) => times.slots_s > 0 ? seconds(times, name) / times.slots_s : 0;
  const worst = causes.reduce((a, b) => part(minute, a.name) >= part(minute, b.name) ? a : b);
  const lost = part(minute, worst.name);
  const column = (key: string, label: string, times: SlotTimes) =>
    ({ key, label, value: ({ name }: Cause) => part(times, name), show: ({ name }: Cause) => percent(part(times, name)) });
  return <div>
    <p>{minute.slots_s <= 0 ? "No slot has worked in the last minute." : lost < 0.1
      ? `The slots are used well: ${percent(part(minute, "busy"))} of their time was spent on evaluations in the last minute.`
      : [<b>{percent(lost)} of the slots' time goes to {worst.name}</b>, `: ${worst.why}. ${worst.todo}`]}</p>
    <div class="split" aria-hidden="true">{Object.keys(kColors).map((name) => <span style={{ width: `${100 * part(minute, name)}%`, background: kColors[name] }} />)}</div>
    <Table name="t" caption="Slot time by cause" rows={[{ name: "busy", why: "evaluating", todo: "" }, ...causes].filter((one) => seconds(all, one.name) > 0)} columns={[
      { key: "name", label: "cause", show: ({ name }) => <span class="meter-cell"><span class="swatch" style={{ background: kColors[name] }} /> {name}</span> },
      column("minute", "last minute", minute), column("all", "since start", all), { key: "why", label: "because" }]} />
    <p><small>Causes that took no time are left out.</small></p>
  </div>;
}

/// Draws shares of the slots' time as stacked areas, and evaluations per second as a line.
function draw_past(pen: Pen, history: History): void {
  const times = history.t_s, n = times.length;
  const left = 52, right = pen.width - 44, top = 8, bottom = pen.height - 20;
  const span = Math.max(1, times[n - 1] - times[0]);
  const at = (i: number, part: number): [number, number] => [left + (right - left) * (times[i] - times[0]) / span, bottom - (bottom - top) * Math.min(1, part)];
  let base = times.map(() => 0);
  for (const [name, color] of Object.entries(kColors)) {
    const values: number[] | undefined = history[name.replace("-", "_")];
    if (!values) continue;
    const above = base.map((below, i) => below + (values[i] ?? 0));
    pen.to.globalAlpha = name === "busy" ? 0.35 : 0.75;
    pen.path([...base.map((part, i) => at(i, part)), ...above.map((part, i) => at(i, part)).reverse()]).fill(color);
    base = above;
  }
  pen.to.globalAlpha = 1;
  const rate = history.evaluations_per_s.map((value) => value ?? 0);
  const most = Math.max(1, ...rate);
  pen.path(rate.map((value, i) => at(i, value / most))).stroke(pen.inks.ink, 1.5);
  for (const part of [0, 0.5, 1]) {
    const y = at(0, part)[1];
    pen.say(number(most * part, 3), left - 6, y, "right");
    pen.say(percent(part), right + 6, y, "left");
    pen.say(part === 1 ? "now" : "−" + duration(span * (1 - part)), left + (right - left) * part, pen.height - 8);
  }
}

function past(history: History) {
  if (history.t_s.length < 2) return <Empty>The process has just started: its history grows every second.</Empty>;
  const label = "Line: evaluations a second (left). Areas: share of the slots' time, busy and by cause (right), colours as above. From the start of this process on.";
  return <div><Canvas height={() => 190} draw={(pen) => draw_past(pen, history)} label={label} /><p><small>{label}</small></p></div>;
}

/// Lost and quarantined workers first, then those with failures, then the most silent.
function worst_first(workers: Worker[]): Worker[] {
  const weight = (one: Worker) => (one.state === "quarantined" ? 3 : one.state !== "connected" ? 2 : one.failed > 0 ? 1 : 0);
  return [...workers].sort((a, b) => weight(b) - weight(a) || b.failed - a.failed || (b.last_heard_s ?? 0) - (a.last_heard_s ?? 0) || a.number - b.number);
}

/// Explanations of the counts whose names are not clear.
const kCounts: Record<string, string> = {
  leased: "tasks that workers hold", ready: "tasks that wait for a slot", failed: "attempts without a score",
  requeued: "leases that went back to the queue", uncommitted: "outcomes that are not on disk yet",
};

function workers_table(workers: Worker[], is_running: boolean) {
  return <Table<Worker> name="w" caption="Workers, worst first" rows={worst_first(workers)} page_size={50}
    row_class={(one) => one.state !== "connected" && "bad"}
    empty={[`No worker ${is_running ? "is" : "has ever been"} connected: `, <code>swarmsmith worker --coordinator {store_word()}.coordinator</code>, " on any host that has this file."]}
    columns={[
      { key: "number", label: "worker" }, { key: "state", show: state_word }, "host", "job", "slots",
      { key: "running", title: "evaluations, as it last reported" },
      { key: "held", title: "leases" },
      { key: "done_per_s", label: "evals/s", show: (one) => number(one.done_per_s, 3) },
      { key: "busy", show: (one) => percent(one.busy), title: "used share of its slots' time, over the last seconds" },
      { key: "last_heard_s", label: "silent for", show: (one) => duration(one.last_heard_s) },
      "done",
      { key: "failed", show: ({ failed }) => <b class={failed ? "warn" : "faint"}>{whole(failed)}</b> },
      "connections"]} />;
}

function quarantine_table(quarantine: Quarantine[]) {
  return quarantine.length > 0 && <div>
    <Table<Quarantine> name="q" caption="In quarantine" rows={quarantine} row_class={() => "bad"} columns={[
      { key: "who", show: ({ who, worker }) => worker ? `${who}, worker ${worker}` : who },
      { key: "since", show: ({ since }) => when(since) }, { key: "reason", label: "because" }, { key: "workers", label: "connected" }]} />
    <p><small><code>swarmsmith forgive {store_word()} KEY|HOST</code> lets them work again.</small></p></div>;
}

export function Fleet({ live: { status, running } }: PageProps) {
  const launcher = status?.launcher;
  return <div>
    <h1>Fleet</h1>
    {!running && <Empty>No campaign runs here: these are the workers that the store knows.</Empty>}
    {status && running && pairs("panel facts", [
      ...(["workers", "slots", "leased", "ready", "done", "failed", "requeued", "lost_workers", "uncommitted"] as const)
        .map((name): [string, string, string?] => [words(name), whole(status[name]), kCounts[name]]),
      ["evaluations/s", number(status.evaluations_per_s, 3)],
      ["up for", duration(status.uptime_s)]])}
    {launcher?.name && <p class="faint">Workers are started by {launcher.name}: {count(launcher.running, "of", "of")} {whole(launcher.wanted)} run{launcher.pending > 0 && `, ${whole(launcher.pending)} wait for ${launcher.waits_for || "their turn"}`}. {launcher.note}</p>}
    <div class="grid">
      {status && running && <Panel title="Where the slots' time goes">
        <Get<{ causes: Cause[] }> path="causes" render={(one) => slot_time(status, one.causes)} /></Panel>}
      {running && <Panel title="The last minutes"><Get<History> path="history" grows="t_s" every_s={2} render={past} /></Panel>}
      <Panel wide title="Workers, worst first" command={command("status", "--watch")}>
        <Get<{ workers: Worker[]; quarantine: Quarantine[] }> path="workers" every_s={running ? 1 : 30}
          render={(one) => <div>{quarantine_table(one.quarantine)}{workers_table(one.workers, running)}</div>} /></Panel>
    </div>
  </div>;
}
