// Questions to the server, or to the snapshot inside the page.

import { given, Query } from "./route";
import { Live } from "./types";

/// An error with the same text as on the command line.
export class ApiError extends Error {
  /// `retry_s`: when to ask again, if the server is only busy.
  constructor(readonly status: number, message: string, readonly where = "", readonly retry_s = 0) { super(message); }
  /// There was no answer at all, so the page should try again.
  get unreachable(): boolean { return this.status === 0; }
}

/// Parsed JSON, or text for other types.
export interface Answer { data: unknown; cost_ms: number }

// --- the snapshot: a page that `dashboard --export` wrote -----------------------------------------
//
// <script id="snapshot" type="text/plain">BASE64</script>: a gzipped JSON object, {"live": {...},
// "c1/designs/d3": {...}, "c1/figures/machine.svg?design=d3": "<svg ..."}. Keys are the paths below
// api/v1/ as `path_of` makes them, without a figure's width.

const snapshot_text = document.getElementById("snapshot")?.textContent?.trim();
export const is_snapshot = !!snapshot_text;
// TypeScript 4.8 does not know DecompressionStream or AbortSignal.timeout yet.
declare const DecompressionStream: new (format: string) => { readable: ReadableStream; writable: WritableStream };

let snapshot: Promise<Record<string, unknown>> | null = null;

async function unpacked(base64: string): Promise<Record<string, unknown>> {
  const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return JSON.parse(await new Response(stream).text());
}

async function from_snapshot(path: string): Promise<Answer> {
  snapshot ??= unpacked(snapshot_text!);
  const key = path.replace(/([?&])width=[^&]*&?/, "$1").replace(/[?&]$/, "");
  const data = (await snapshot)[key];
  if (data === undefined)
    throw new ApiError(404, "this file does not contain it; open the store with swarmsmith dashboard", key);
  return { data, cost_ms: 0 };
}

// --- the token ------------------------------------------------------------------------------------

/// Takes the token from "#t=..." in the address that `run` printed; it is kept only in this tab.
function take_token(): void {
  const found = /[#&]t=([^&]+)/.exec(location.hash);
  if (!found) return;
  sessionStorage.setItem("token", decodeURIComponent(found[1]));
  history.replaceState(null, "", location.pathname + location.search + "#/");
}
take_token();

export function token(): string | null {
  return sessionStorage.getItem("token");
}
export function set_token(text: string): void {
  if (text === "") sessionStorage.removeItem("token"); else sessionStorage.setItem("token", text);
}

// --- asking ---------------------------------------------------------------------------------------

/// "c1/designs/d3/race?iteration=8": parameters in the given order, without those that have no
/// value.
export function path_of(path: string, parameters: Query = {}): string {
  const values = given(parameters).map(([name, value]) => `${name}=${encodeURIComponent(value)}`);
  return path + (values.length ? "?" + values.join("&") : "");
}

/// Earlier answers of the server, by path.
const kept = new Map<string, { etag: string; data: unknown }>();
const kMostKept = 40;

/// A successful answer, or "unchanged" (304). Throws ApiError.
async function fetched(path: string, patience_ms: number, headers: Record<string, string> = {}, method = "GET"): Promise<Response> {
  const secret = token();
  if (secret) headers.Authorization = "Bearer " + secret;
  let response: Response;
  try {
    response = await fetch("api/v1/" + path, { method, headers, signal: (AbortSignal as any).timeout(patience_ms), credentials: "omit" });
  } catch (error) {
    throw new ApiError(0, (error as Error).name === "TimeoutError"
      ? `no answer within ${patience_ms / 1000} s` : "no answer: the process that serves this page cannot be reached", path);
  }
  if (response.ok || response.status === 304) return response;
  const { error = { message: `the server answered ${response.status} ${response.statusText}`, where: path } }
    = await response.json().catch(() => ({}));
  throw new ApiError(response.status, error.message, error.where, response.status === 503 ? Number(response.headers.get("Retry-After") ?? 1) : 0);
}

/// The progress of an answer that is still being computed.
export interface Pending { seconds: number }

/// The data at a path below api/v1/. If the server says that an answer has not changed (ETag, 304),
/// returns the same object as before. Throws ApiError.
/// If the computation takes long (202), `waits` is called with its time so far, and the answer is
/// fetched when it is ready.
export async function ask(path: string, patience_ms = 65000, waits?: (pending: Pending) => void): Promise<Answer> {
  if (is_snapshot) return from_snapshot(path);
  const before = kept.get(path);
  let response: Response | undefined;
  for (let attempt = 1; !response; ++attempt) {
    try {
      const got = await fetched(path, patience_ms, before && { "If-None-Match": before.etag });
      if (got.status !== 202) response = got;
      else {
        attempt = 0;
        waits?.((await got.json()).pending);
        await new Promise((done) => setTimeout(done, 1000));
      }
    } catch (error) {
      const { retry_s } = error as ApiError;
      if (!retry_s || attempt > 3 || path === "live") throw error;
      await new Promise((done) => setTimeout(done, 1000 * retry_s));  // the server is busy
    }
  }
  const cost_ms = Number(/dur=([\d.]+)/.exec(response.headers.get("Server-Timing") ?? "")?.[1] ?? 0);
  if (response.status === 304) return { data: before!.data, cost_ms };
  let data: unknown;
  try {
    data = await (response.headers.get("Content-Type")?.includes("json") ? response.json() : response.text());
  } catch { throw new ApiError(0, "the answer is incomplete", path); }
  const etag = response.headers.get("ETag");
  kept.delete(path);
  // An answer with only the new values (after=...) is never asked for again, so it is not kept.
  if (etag && !/[?&]after=/.test(path)) kept.set(path, { etag, data });
  if (kept.size > kMostKept) kept.delete(kept.keys().next().value as string);
  return { data, cost_ms };
}

/// Sends a command, which needs the token. Returns a sentence that says what was done. Throws
/// ApiError.
export async function post(path: string): Promise<string> {
  return (await (await fetched(path, 15000, {}, "POST")).json()).done;
}

// --- live numbers ---------------------------------------------------------------------------------

/// Time between questions when no campaign is running.
const kAtRest_ms = 5000;

/// Asks for `live` once a second while the page is visible, and calls the listeners. All pages ask
/// at the same moment, the full second, so that the server makes one answer for all of them.
class Feed {
  live: Live | null = null;
  at: Date | null = null;             ///< time of the last answer
  failure: ApiError | null = null;    ///< error of the last attempt, if it failed
  next_try: Date | null = null;
  #listeners = new Set<() => void>();
  #timer = 0;
  #failures = 0;
  #is_asking = false;

  /// Returns a function that ends the listening.
  listen(what: () => void): () => void {
    this.#listeners.add(what);
    return () => { this.#listeners.delete(what); };
  }

  start(): void {
    document.addEventListener("visibilitychange", () => {
      this.#tell();
      this.ask_now();
    });
    this.ask_now();
  }

  /// True while the numbers on the page are out of date.
  get stale(): boolean { return !!this.failure || !is_snapshot && !!this.at && Date.now() - +this.at > 2 * kAtRest_ms; }

  #tell(): void { this.#listeners.forEach((listener) => listener()); }

  ask_now(): void {
    clearTimeout(this.#timer);
    // If the page is hidden, it asks again when it becomes visible.
    if (!this.#is_asking && !(document.hidden && this.live)) void this.#turn();
  }

  async #turn(): Promise<void> {
    this.#is_asking = true;
    try {
      const live = (await ask("live", 3000)).data as Live;
      if (this.live && live.boot !== this.live.boot) restarted();
      this.live = live;
      this.at = new Date();
      this.failure = null;
      this.#failures = 0;
    } catch (error) {
      this.failure = error as ApiError;
      ++this.#failures;
    }
    this.#is_asking = false;
    const now = Date.now(), pause = this.live?.running ? 1000 : kAtRest_ms;
    const next = this.failure ? now + Math.min(15000, 1000 * 2 ** (this.#failures - 1)) : Math.ceil((now + pause - 500) / 1000) * 1000;
    this.next_try = this.failure ? new Date(next) : null;
    if (!is_snapshot) this.#timer = window.setTimeout(() => this.ask_now(), next - now);
    this.#tell();
  }
}

/// Another process answers at this address, so all kept answers belong to the previous one.
function restarted(): void {
  sessionStorage.setItem("notice", `Another process has answered at this address since ${new Date().toLocaleTimeString("en-GB")}: `
    + "the page was reloaded, and shows its numbers.");
  location.reload();
}

export const feed = new Feed();
