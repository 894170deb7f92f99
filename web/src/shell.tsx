import { Component, h } from "preact";
import { feed, is_snapshot } from "./api";
import { announce, Bar } from "./components";
import { clock, count, duration, number, percent, shell_word, whole } from "./format";
import { Key, Page, Place } from "./page";
import { current_route, go, href, match, Route } from "./route";
import { Campaign, Live } from "./types";

// --- light and dark ----------------------------------------------------------------------------------

const dark_wish = matchMedia("(prefers-color-scheme: dark)");

function theme(): string {
  let choice: string | null = null;
  try { choice = localStorage.getItem("theme"); } catch { /* a file may have no storage */ }
  return choice ?? (dark_wish.matches ? "dark" : "light");
}

export function show_theme(): void {
  document.documentElement.dataset.theme = theme();
  document.dispatchEvent(new CustomEvent("theme"));
}
dark_wish.addEventListener("change", show_theme);

function switch_theme(): void {
  try { localStorage.setItem("theme", theme() === "dark" ? "light" : "dark"); } catch { return; }
  show_theme();
}

// --- what needs a look -------------------------------------------------------------------------------

export interface Look { text: string; address: string }

/// What somebody should know of, worst first.
export function looks(live: Live): Look[] {
  const found: Look[] = [];
  const say = (when: boolean | number | string, text: string, address = "#/fleet") => { if (when) found.push({ text, address }); };
  const s = live.status;
  if (s) {
    say(s.trouble, s.trouble);
    say(s.conflicts, `${count(s.conflicts, "conflict")}: two results of one evaluation differ in their bits`);
    say(s.insecure_plaintext, "other hosts can connect without keys");
    say(s.quarantined, `${count(s.quarantined, "worker")} in quarantine`);
    say(live.running && s.workers === 0, "no worker is connected");
    say(s.lost_workers, `${count(s.lost_workers, "worker")} lost`);
    say(s.rejected, `${count(s.rejected, "evaluation")} rejected`, href(["c1"]));
    say(s.failed, `${count(s.failed, "attempt")} failed`, href(["c1"]));
    say(s.malformed, `${count(s.malformed, "frame")} dropped as malformed`);
  }
  for (const { c, name, trouble, state, designs } of live.campaigns) {
    say(trouble, `${name}: ${trouble}`, href([c]));
    say(state === "interrupted", `${name} is not finished, and nobody runs it`, href([c]));
    for (const { id, state } of designs) say(state === "stopped", `${id} has stopped`, href([c, id]));
  }
  return found;
}

// --- the page around all pages -----------------------------------------------------------------------

/// The rate is that of the last minute: a process that has just begun has none.
export function eta_of(live: Live, eta_s: number | null): string {
  return eta_s !== null ? duration(eta_s) : live.status && live.status.uptime_s < 60 ? "not known yet" : "none: nothing moves";
}

/// The campaign and design that the address is about, else those most worth a look.
function place_of(route: Route, live: Live, before: Place | null): Place | null {
  const known = (c: string) => live.campaigns.find((campaign) => campaign.c === c);
  const [c, d] = route.path;
  const campaign = known(c) ?? (before && known(before.c)) ?? live.campaigns[0];
  if (!campaign) return null;
  const design = campaign.designs.find((one) => one.id === d)
    ?? (before?.c === campaign.c ? campaign.designs.find((one) => one.id === before.d) : undefined)
    ?? campaign.designs.find((one) => one.state === "racing") ?? campaign.designs[0];
  return { c: campaign.c, d: design?.id ?? null };
}

function seconds_since(time: Date): number { return (Date.now() - time.getTime()) / 1000; }

class Head extends Component<{ live: Live | null; now: number }, {}> {
  render() {
    const { live } = this.props;
    const s = live?.status;
    const used = live ? sum(live.campaigns, (one) => one.used) : 0;
    const budget = live ? sum(live.campaigns, (one) => one.budget) : 0;
    const names = live ? live.campaigns.map((one) => one.name) : [];
    const name = names.length === 0 ? "Swarmsmith" : names.length <= 2 ? names.join(", ") : `${names.length} campaigns`;
    const todo = live ? looks(live) : [];
    const state = !live ? "" : is_snapshot ? "a file" : live.running ? "running" : live.campaigns.every((one) => one.state === "finished") ? "finished" : "at rest";
    return <header class="head">
      <a class="brand" href="#/" title="All campaigns">{name}</a>
      {live && <span class="faint where" title={live.campaigns.map((one) => one.store).join("\n")}>{live.user}@{live.host}</span>}
      {live && <span class={`state state-${state.replace(" ", "-")}`}>{state}</span>}
      {live && <span class="progress" title={`${whole(used)} of ${whole(budget)} experiments`}>
        <Bar value={used} of={budget} name="experiments used" /> {percent(budget > 0 ? used / budget : 0)}</span>}
      {s && live.running && <span><b>{number(s.evaluations_per_s, 3)}</b> evaluations/s</span>}
      {s && live.running && <span>ETA <b>{eta_of(live, s.eta_s)}</b></span>}
      {todo.length > 0 && <details class="looks"><summary>{count(todo.length, "thing needs", "things need")} a look</summary>
        <ul>{todo.slice(0, 12).map((look) => <li><a href={look.address}>{look.text}</a></li>)}</ul></details>}
      <span class="push faint" title={feed.at ? feed.at.toISOString() : ""}>{feed.at ? `as of ${clock(feed.at)}` : ""}</span>
      <button class="quiet" aria-label="light or dark" title="light or dark" onClick={switch_theme}>◐</button>
      <button class="quiet" aria-label="keys" title="keys (?)" onClick={() => document.dispatchEvent(new CustomEvent("help"))}>?</button>
    </header>;
  }
}

function sum(campaigns: Campaign[], of: (campaign: Campaign) => number): number {
  return campaigns.reduce((total, campaign) => total + of(campaign), 0);
}

/// What is wrong with the connection, if anything is.
function Connection() {
  const { failure, at, live, next_try } = feed;
  if (!failure) return null;
  const over = live && !live.campaigns.some((one) => one.state === "running") && failure.unreachable;
  const again = next_try ? Math.max(0, Math.ceil(-seconds_since(next_try))) : 0;
  const command = `swarmsmith dashboard ${live?.campaigns.map((one) => shell_word(one.store)).join(" ") ?? "STORE"}`;
  if (over)
    return <p class="banner" role="status">Nothing runs any more, and the process that served this page has ended. See it again: <code>{command}</code></p>;
  return <p class="banner warn" role="status">{failure.unreachable
    ? `No answer since ${at ? clock(at) : "the page was opened"}, trying again ${again > 0 ? `in ${again} s` : "now"}. The numbers below are old. If the process has ended, see them again: ${command}`
    : `${failure.where ? failure.where + ": " : ""}${failure.message}`}</p>;
}

class Help extends Component<{ pages: Page[]; keys: Key[] }, {}> {
  private dialog: HTMLDialogElement | null = null;
  open = () => { if (!this.dialog?.open) this.dialog?.showModal(); };
  componentDidMount() { document.addEventListener("help", this.open); }
  componentWillUnmount() { document.removeEventListener("help", this.open); }
  render() {
    const { pages, keys } = this.props;
    const all: Key[] = [{ key: "?", what: "these keys" },
      ...pages.filter((page) => page.nav).map((page) => ({ key: "g " + page.nav!.letter, what: "go to " + page.nav!.label.toLowerCase() })),
      { key: "/", what: "filter the first table" }, ...keys];
    return <dialog aria-label="Keys" ref={(e: any) => (this.dialog = e)}>
      <h2>Keys</h2>
      <dl class="keys">{all.map(({ key, what }) => <div><dt><kbd>{key}</kbd></dt><dd>{what}</dd></div>)}</dl>
      <div class="tools"><button onClick={() => this.dialog?.close()}>Close</button></div>
    </dialog>;
  }
}

interface ShellState { route: Route; tick: number; notice: string }

export class Shell extends Component<{ pages: Page[] }, ShellState> {
  state: ShellState = { route: current_route(), tick: 0, notice: sessionStorage.getItem("notice") ?? "" };
  private place: Place | null = null;
  private gone_to = "";
  private waits_for_letter = 0;

  componentDidMount() {
    sessionStorage.removeItem("notice");
    addEventListener("hashchange", this.follow);
    addEventListener("keydown", this.key);
    feed.listen(() => this.setState({ tick: this.state.tick + 1 }));
    // The seconds of "trying again in 4 s".
    setInterval(() => { if (feed.stale) this.setState({ tick: this.state.tick + 1 }); }, 1000);
    feed.start();
  }

  private follow = () => { this.setState({ route: current_route() }); };

  componentDidUpdate() {
    const { page, params } = this.found();
    const title = page ? page.title(params) : "No such page";
    const name = feed.live?.campaigns.map((one) => one.name).join(", ") ?? "";
    document.title = [title, name, feed.live?.host, "Swarmsmith"].filter(Boolean).join(" · ");
    document.body.classList.toggle("stale", feed.stale);
    const path = this.state.route.path.join("/");
    if (path !== this.gone_to && feed.live) {
      // Another page, for who hears it: its title is said, and Tab begins at its start.
      if (this.gone_to !== "") { announce(title); scrollTo(0, 0); }
      this.gone_to = path;
    }
  }

  private found(): { page: Page | null; params: Record<string, string> } {
    for (const page of this.props.pages) {
      const params = match(page.pattern, this.state.route.path);
      if (params) return { page, params };
    }
    return { page: null, params: {} };
  }

  private nav_path(page: Page): string[] | null { return this.place && page.nav ? page.nav.path(this.place) : null; }

  private key = (event: KeyboardEvent) => {
    const target = event.target as HTMLElement;
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (/^(INPUT|TEXTAREA|SELECT)$/.test(target.tagName) && (target as HTMLInputElement).type !== "range") return;
    if (Date.now() - this.waits_for_letter < 1500) {
      this.waits_for_letter = 0;
      const page = this.props.pages.find((one) => one.nav?.letter === event.key);
      const path = page && this.nav_path(page);
      if (path) { event.preventDefault(); go(href(path)); }
    } else if (event.key === "g") {
      this.waits_for_letter = Date.now();
    } else if (event.key === "?") {
      document.dispatchEvent(new CustomEvent("help"));
    } else if (event.key === "/") {
      const field = document.querySelector<HTMLInputElement>("main input[type=search]");
      if (field) { event.preventDefault(); field.focus(); }
    }
  };

  render() {
    const { pages } = this.props;
    const { route, notice } = this.state;
    const live = feed.live;
    const { page, params } = this.found();
    if (live) this.place = place_of(route, live, this.place);
    return <div class="shell">
      <a class="skip" href="#main" onClick={(e) => { e.preventDefault(); document.getElementById("main")?.focus(); }}>To the page</a>
      <Head live={live} now={this.state.tick} />
      <nav class="nav" aria-label="pages"><ul>{pages.filter((one) => one.nav).map((one) => {
        const path = this.nav_path(one);
        return path && <li><a href={href(path)} aria-current={one === page ? "page" : undefined}>{one.nav!.label}</a></li>;
      })}</ul></nav>
      {notice && <p class="banner" role="status">{notice} <button class="quiet" onClick={() => this.setState({ notice: "" })}>Close</button></p>}
      <Connection />
      <main id="main" tabIndex={-1}>{!live
        ? feed.failure ? null : <p class="waiting">Asking the server …</p>
        : page ? h(page.view as any, { key: page.pattern, params, query: route.query, live })
          : <p class="empty">There is no page at {location.hash}. <a href="#/">All campaigns</a></p>}</main>
      <Help pages={pages} keys={page?.keys ?? []} />
    </div>;
  }
}
