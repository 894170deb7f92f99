import { Component, h } from "preact";
import { Canvas, Inks, pen } from "../canvas";
import { Empty, Fact, Panel, StateWord, Table } from "../components";
import { count, duration, number, percent, shell_word, whole, words } from "../format";
import { Get } from "../get";
import { Page, PageProps } from "../page";
import { History, SlotTimes, Status, Worker } from "../types";

interface Cause { name: string; color: string; what: string; todo: string }

/// Why slots idle (docs/observability.md), and what a person can do. Names as in /status.
const kCauses: Cause[] = [
  { name: "busy", color: "#0072b2", what: "evaluating", todo: "" },
  { name: "start-up", color: "#56b4e9", what: "new workers get what they must know", todo: "It passes by itself." },
  { name: "barrier", color: "#e69f00", what: "races wait for the last results of a step", todo: "Run more designs at the same time, or use fewer slots." },
  { name: "credit", color: "#cc79a7", what: "workers ask for less than they have slots for", todo: "They drain, or have many results that are not acknowledged: look at their silence below." },
  { name: "alone", color: "#999999", what: "workers are kept free for a task that may have killed one", todo: "It passes when that task has run alone." },
  { name: "commit", color: "#d55e00", what: "the store cannot write as fast, or not at all", todo: "Look at the disk of the store: space, speed." },
  { name: "held", color: "#f0e442", what: "what is wanted is of paused designs, or the coordinator ends", todo: "Resume the paused designs." },
  { name: "network", color: "#009e73", what: "tasks and results are on their way", todo: "Short evaluations, slow connections, or worker hosts whose processors are taken by others." },
];

function seconds_of(times: SlotTimes, cause: string): number {
  return cause === "busy" ? times.busy_s : times.idle_s[cause] ?? 0;
}

function SlotTime({ status }: { status: Status }) {
  const [minute, whole_time] = [status.slot_times_last_minute, status.slot_times];
  const part = (times: SlotTimes, name: string) => times.slots_s > 0 ? seconds_of(times, name) / times.slots_s : 0;
  const worst = kCauses.slice(1).reduce((a, b) => part(minute, a.name) >= part(minute, b.name) ? a : b);
  const lost = part(minute, worst.name);
  return <div>
    <p>{minute.slots_s <= 0 ? "No slot has worked in the last minute." : lost < 0.1
      ? `The slots are used well: ${percent(part(minute, "busy"))} of their time was spent on evaluations in the last minute.`
      : <span><b>{percent(lost)} of the slots' time goes to {worst.name}</b>: {worst.what}. {worst.todo}</span>}</p>
    <div class="split" aria-hidden="true">{kCauses.map((cause) => <span style={{ width: `${100 * part(minute, cause.name)}%`, background: cause.color }} />)}</div>
    <Table<Cause> name="t" caption="Slot time by cause" rows={kCauses.filter((cause) => seconds_of(whole_time, cause.name) > 0)}
      columns={[
        { key: "name", label: "cause", show: (cause) => <span class="meter-cell"><span class="swatch" style={{ background: cause.color }} /> {cause.name}</span> },
        { key: "minute", label: "last minute", value: (cause) => part(minute, cause.name), show: (cause) => percent(part(minute, cause.name)) },
        { key: "all", label: "since start", value: (cause) => part(whole_time, cause.name), show: (cause) => percent(part(whole_time, cause.name)) },
        { key: "what", label: "because" },
      ]} />
    <p class="faint small">Causes that took no time are left out.</p>
  </div>;
}

/// Shares of the slots' time as areas above each other, and evaluations a second as a line.
class Past extends Component<{ history: History }, {}> {
  private draw = (to: CanvasRenderingContext2D, width: number, height: number, inks: Inks) => {
    const { history } = this.props;
    const { say, line } = pen(to, inks);
    const times = history.t_s, n = times.length;
    const left = 52, right = width - 44, top = 8, bottom = height - 20;
    const span = Math.max(1, times[n - 1] - times[0]);
    const x = (i: number) => left + (right - left) * (times[i] - times[0]) / span;
    const y = (part: number) => bottom - (bottom - top) * Math.min(1, part);
    const base = times.map(() => 0);
    for (const { name, color } of kCauses) {
      const values: number[] | undefined = history[name.replace("-", "_")];
      if (!values) continue;
      to.beginPath();
      for (let i = 0; i < n; ++i) to.lineTo(x(i), y(base[i]));
      for (let i = n; i-- > 0;) to.lineTo(x(i), y(base[i] += values[i] ?? 0));
      to.fillStyle = color;
      to.globalAlpha = name === "busy" ? 0.35 : 0.75;
      to.fill();
    }
    to.globalAlpha = 1;
    const rate = history.evaluations_per_s.map((value) => value ?? 0);
    const most = Math.max(1, ...rate);
    line(inks.ink, rate.map((value, i) => [x(i), y(value / most)]));
    for (const part of [0, 0.5, 1]) {
      say(number(most * part, 3), left - 6, y(part), "right");
      say(percent(part), right + 6, y(part), "left");
      say(part === 1 ? "now" : "−" + duration(span * (1 - part)), left + (right - left) * part, height - 8);
    }
  };
  render() {
    const { history } = this.props;
    if (history.t_s.length < 2) return <Empty>The process has just begun: its history comes second by second.</Empty>;
    return <div><Canvas height={() => 190} draw={this.draw}
      label="Evaluations a second, and shares of the slots' time by cause, since the process began or over the last minutes" />
      <p class="faint small">Line: evaluations a second (left). Areas: share of the slots' time, busy and by cause (right), colours as above. It begins with this process.</p></div>;
  }
}

/// Lost and quarantined workers first, then those with failures, then the most silent.
function worst_first(workers: Worker[]): Worker[] {
  const weight = (one: Worker) => (one.state === "quarantined" ? 3 : one.state !== "connected" ? 2 : one.failed > 0 ? 1 : 0);
  return [...workers].sort((a, b) => weight(b) - weight(a) || b.failed - a.failed || (b.last_heard_s ?? 0) - (a.last_heard_s ?? 0) || a.number - b.number);
}

/// What the counts mean whose names do not say it.
const kCounts: Record<string, string> = {
  leased: "tasks that workers hold", ready: "tasks that wait for a slot", failed: "attempts without a score",
  requeued: "leases that went back to the queue", uncommitted: "outcomes that are not on disk yet",
};

class Fleet extends Component<PageProps, {}> {
  private workers(workers: Worker[], running: boolean, store: string) {
    return <Table<Worker> name="w" caption="Workers, worst first" rows={worst_first(workers)}
      row_class={(one) => one.state === "connected" ? "" : "bad"}
      empty={<span>No worker{running ? " is connected" : " has ever been connected"}: <code>swarmsmith worker --coordinator {store}.coordinator</code> on any host that has this file.</span>}
      columns={[
        { key: "number", label: "worker" },
        { key: "state", show: (one) => <StateWord state={one.state} /> },
        { key: "host" },
        { key: "job" },
        { key: "slots" },
        { key: "running", title: "evaluations, as it last said" },
        { key: "held", title: "leases" },
        { key: "done_per_s", label: "evals/s", show: (one) => number(one.done_per_s, 3) },
        { key: "busy", show: (one) => percent(one.busy), title: "share of its slots' time, over the last seconds" },
        { key: "last_heard_s", label: "silent for", show: (one) => duration(one.last_heard_s) },
        { key: "done" },
        { key: "failed", show: (one) => <b class={one.failed ? "warn" : "faint"}>{whole(one.failed)}</b> },
        { key: "connections" },
      ]} />;
  }

  render() {
    const { live } = this.props;
    const s = live.status;
    const store = live.campaigns[0]?.store ?? "STORE";
    return <div>
      <h1>Fleet</h1>
      {!live.running && <Empty>No campaign runs here, so no worker works for it. Below are those that did, as the store knows them.</Empty>}
      {s && live.running && <dl class="facts framed">
        {(["workers", "slots", "leased", "ready", "done", "failed", "requeued", "lost_workers", "uncommitted"] as const).map((name) =>
          <Fact name={words(name)} title={kCounts[name]}>{whole(s[name])}</Fact>)}
        <Fact name="evaluations/s">{number(s.evaluations_per_s, 3)}</Fact>
        <Fact name="up for">{duration(s.uptime_s)}</Fact>
      </dl>}
      {s?.launcher?.name && <p class="faint">Workers are started by {s.launcher.name}: {count(s.launcher.running, "of", "of")} {whole(s.launcher.wanted)} run{s.launcher.pending > 0 && `, ${whole(s.launcher.pending)} wait for ${s.launcher.waits_for || "their turn"}`}. {s.launcher.note}</p>}
      <div class="grid">
        {s && live.running && <Panel title="Where the slots' time goes"><SlotTime status={s} /></Panel>}
        {live.running && <Panel title="The last minutes"><Get<History> path="history" every_s={2} render={(history) => <Past history={history} />}
          missing={(error) => <Empty>{error.message}</Empty>} /></Panel>}
        <Panel wide title="Workers, worst first" command={`swarmsmith status ${shell_word(store)} --watch`}>
          <Get<{ workers: Worker[] }> path="workers" every_s={live.running ? 1 : 30} render={({ workers }) => this.workers(workers, live.running, store)} /></Panel>
      </div>
    </div>;
  }
}

export const fleet: Page = {
  pattern: "fleet", title: () => "Fleet", view: Fleet,
  nav: { label: "Fleet", letter: "f", path: () => ["fleet"] },
};
