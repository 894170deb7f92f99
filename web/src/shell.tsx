import { Component, h } from "preact";
import { feed, is_snapshot } from "./api";
import { announce, Bar, Empty, is_typing, pairs, part_of, Quiet, spent_of, state_word, Waiting } from "./components";
import { clock, count, duration, number, percent, shell_word } from "./format";
import { Page } from "./page";
import { current_route, filled, go, href, match } from "./route";
import { Design, Live } from "./types";

/// The reader's current place: the navigation links to the pages of this campaign and design.
type Place = { c?: string; d?: string };

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

/// Problems that need attention, as links.
export function look_list(looks: Live["looks"], most: number) {
  return <ul class="look">{looks.slice(0, most).map(({ text, page }) => <li><a href={"#/" + page}>{text}</a></li>)}
    {looks.length > most && <li class="faint">and {looks.length - most} more</li>}</ul>;
}

// --- the frame around all pages ---------------------------------------------------------------------

/// The rate is measured over the last minute, so a process that has just begun has none.
export function eta_of({ status }: Live, eta_s: number | null): string {
  return eta_s !== null ? duration(eta_s) : status && status.uptime_s < 60 ? "not known yet" : "none: no progress";
}

/// The campaign and design in the address, else those that most need attention.
function place_in([c, d]: string[], { campaigns }: Live, before: Place): Place {
  const campaign = campaigns.find((one) => one.c === c) ?? campaigns.find((one) => one.c === before.c) ?? campaigns[0];
  const design = (test: (one: Design) => boolean) => campaign?.designs.find(test);
  return { c: campaign?.c, d: (design(({ id }) => id === d) ?? design(({ id }) => campaign.c === before.c && id === before.d)
    ?? design(({ state }) => state === "racing") ?? campaign?.designs[0])?.id };
}

function help(): void { document.dispatchEvent(new CustomEvent("help")); }

function Head({ live }: { live: Live | null }) {
  const toggles = [<Quiet label="light or dark" act={switch_theme}>◐</Quiet>,
    <Quiet label="keys" title="keys (?)" act={help}>?</Quiet>];
  if (!live) return <header class="head"><a class="brand" href="#/">Swarmsmith</a>{toggles}</header>;
  const { status, campaigns, running, looks } = live;
  const sum = (what: "used" | "budget" | "left") => campaigns.reduce((total, one) => total + one[what], 0);
  const spent = { used: sum("used"), budget: sum("budget"), left: sum("left") };
  const is_finished = campaigns.length > 0 && campaigns.every((one) => one.state === "finished");
  const state = is_snapshot ? "a file" : is_finished ? "finished" : feed.failure?.unreachable ? "lost" : running ? "running" : "at rest";
  return <header class="head">
    <a class="brand" href="#/" title="All campaigns">{campaigns.length > 2 ? `${campaigns.length} campaigns` : campaigns.map((one) => one.name).join(", ") || "Swarmsmith"}</a>
    <span class="faint" title={campaigns.map((one) => one.store).join("\n")}>{live.host && `${live.user}@${live.host}`}</span>
    {state_word({ state })}
    <span class="progress" title={`${spent_of(spent)} experiments`}>
      {spent.budget > 0 && [<Bar of={spent} name="experiments used" />, " ", percent(part_of(spent))]}</span>
    {status && running && !is_finished && [<span><b>{number(status.evaluations_per_s, 3)}</b> evaluations/s</span>,
      <span>ETA <b>{eta_of(live, status.eta_s)}</b></span>]}
    {looks.length > 0 && <details class="looks"><summary>{count(looks.length, "thing needs", "things need")} a look</summary>{look_list(looks, 12)}</details>}
    <span class="push faint" title={feed.at?.toISOString()}>{feed.at && `as of ${clock(feed.at)}`}</span>
    {toggles}
  </header>;
}

/// Describes problems with the connection, if there are any.
function Connection() {
  const { failure, at, live, next_try } = feed;
  if (!failure) return null;
  const again_s = next_try ? Math.ceil((next_try.getTime() - Date.now()) / 1000) : 0;
  const command = `swarmsmith dashboard ${live?.campaigns.map((one) => shell_word(one.store)).join(" ") ?? "STORE"}`;
  if (live && failure.unreachable && !live.campaigns.some((one) => one.state === "running"))
    return <p class="banner" role="status">{live.campaigns.every((one) => one.state === "finished") ? "Finished" : "No campaign is running"}, and the process that served this page has ended. To open it again, run: <code>{command}</code></p>;
  return <p class="banner warn" role="status">{failure.unreachable
    ? `No answer since ${at ? clock(at) : "the page was opened"}, trying again ${again_s > 0 ? `in ${again_s} s` : "now"}. The numbers below are old. If the process has ended, its command continues where it stopped; to see what is stored, run: ${command}`
    : `${failure.where && failure.where + ": "}${failure.message}`}</p>;
}

class Help extends Component<{ pages: Page[]; keys: Page["keys"] }, {}> {
  #dialog!: HTMLDialogElement;
  #open = () => { if (!this.#dialog.open) this.#dialog.showModal(); };
  componentDidMount() { document.addEventListener("help", this.#open); }
  render({ pages, keys = [] }: { pages: Page[]; keys: Page["keys"] }) {
    const all = [["?", "these keys"], ...pages.filter((page) => page.letter).map(({ letter, label }) => ["g " + letter, "go to " + label.toLowerCase()]),
      ["/", "filter the first table"], ...keys];
    return <dialog aria-label="Keys" ref={(it: any) => (this.#dialog = it)}>
      <h2>Keys</h2>
      {pairs("keys", all.map(([key, what]) => [<kbd>{key}</kbd>, what]))}
      <div class="tools"><button onClick={() => this.#dialog.close()}>Close</button></div>
    </dialog>;
  }
}

interface ShellState { notice: string | null }

export class Shell extends Component<{ pages: Page[] }, ShellState> {
  state: ShellState = { notice: sessionStorage.getItem("notice") };
  #place: Place = {};
  #gone_to = "";
  #waits_for_letter = 0;

  componentDidMount() {
    const renew = () => this.setState({});
    sessionStorage.removeItem("notice");
    addEventListener("hashchange", renew);
    addEventListener("keydown", this.#key);
    feed.listen(renew);
    // Updates the seconds in "trying again in 4 s".
    setInterval(() => { if (feed.stale) renew(); }, 1000);
    feed.start();
  }

  componentDidUpdate() {
    const { page, params: { c, ...params } } = this.#found();
    const { live, stale } = feed;
    const title = page ? [page.label, ...Object.values(params)].join(" ") : "No such page";
    document.title = [title, live?.campaigns.map((one) => one.name).join(", "), live?.host, "Swarmsmith"].filter(Boolean).join(" · ");
    document.body.classList.toggle("stale", stale);
    const path = current_route().path.join("/");
    if (path !== this.#gone_to && live) {
      // On a new page, screen readers announce its title, and Tab begins at its start.
      if (this.#gone_to) { announce(title); scrollTo(0, 0); }
      this.#gone_to = path;
    }
  }

  #found(): { page?: Page; params: Record<string, string> } {
    for (const page of this.props.pages) {
      const params = match(page.pattern, current_route().path);
      if (params) return { page, params };
    }
    return { params: {} };
  }

  #key = (event: KeyboardEvent) => {
    if (is_typing(event)) return;
    if (Date.now() - this.#waits_for_letter < 1500) {
      this.#waits_for_letter = 0;
      const page = this.props.pages.find((one) => one.letter === event.key);
      const path = page && filled(page.pattern, this.#place);
      if (path) { event.preventDefault(); go(href(path)); }
    } else if (event.key === "g") {
      this.#waits_for_letter = Date.now();
    } else if (event.key === "?") {
      help();
    } else if (event.key === "/") {
      const field = document.querySelector<HTMLInputElement>("main input[type=search]");
      if (field) { event.preventDefault(); field.focus(); }
    }
  };

  #view(live: Live, page: Page | undefined, params: Record<string, string>) {
    const { c, d } = params;
    const campaign = live.campaigns.find((one) => one.c === c), design = campaign?.designs.find((one) => one.id === d);
    const missing = !page ? `page at ${location.hash}` : c && !campaign ? `campaign ${c} here` : d && !design ? `design ${d} in ${c}` : "";
    return missing ? <Empty>There is no {missing}. <a href="#/">All campaigns</a></Empty>
      : h(page!.view as any, { key: page!.pattern, params, query: current_route().query, live, campaign, design });
  }

  render({ pages }: { pages: Page[] }, { notice }: ShellState) {
    const { live, failure } = feed;
    const { page, params } = this.#found();
    if (live) this.#place = place_in(current_route().path, live, this.#place);
    return <div>
      <a class="skip" href="#main" onClick={(event) => { event.preventDefault(); document.getElementById("main")!.focus(); }}>Skip to content</a>
      <Head live={live} />
      <nav class="nav" aria-label="pages"><ul>{pages.map((one) => {
        const path = one.letter && filled(one.pattern, this.#place);
        return path && <li><a href={href(path)} aria-current={one === page ? "page" : undefined}>{one.label}</a></li>;
      })}</ul></nav>
      {notice && <p class="banner" role="status">{notice} <Quiet act={() => this.setState({ notice: null })}>Close</Quiet></p>}
      <Connection />
      <main id="main" tabIndex={-1}>{live ? this.#view(live, page, params) : !failure && <Waiting />}</main>
      <Help pages={pages} keys={page?.keys} />
    </div>;
  }
}
