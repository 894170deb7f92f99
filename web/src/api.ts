// Questions to the server, or to the snapshot that is in the page itself.

import { Live } from "./types";

/// What went wrong, as the command line says it.
export class ApiError extends Error {
  constructor(readonly status: number, readonly kind: string, message: string, readonly where = "") { super(message); }
  /// No answer came at all: it is worth trying again.
  get unreachable(): boolean { return this.status === 0; }
}

interface Kept { etag: string; text: string; data: unknown }

export interface Answer { text: string; data: unknown; cost_ms: number }

// --- the snapshot: a page that `dashboard --export` wrote -----------------------------------------
//
// <script id="snapshot" type="text/plain">BASE64</script>: a gzipped JSON object, {"live": {...},
// "c1/designs/d3": {...}, "c1/figures/machine.svg?design=d3": "<svg ..."}. Keys are the paths below
// api/v1/ as `path_of` makes them, without a figure's width.

const snapshot_text = document.getElementById("snapshot")?.textContent?.trim();
export const is_snapshot = !!snapshot_text;
// TypeScript 4.8 does not know it yet.
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
    throw new ApiError(404, "not_found", "this file does not hold it: see it in the store with swarmsmith dashboard", key);
  return { text: typeof data === "string" ? data : JSON.stringify(data), data, cost_ms: 0 };
}

// --- the token ------------------------------------------------------------------------------------

/// From "#t=..." of the address that `run` printed; it stays in this tab.
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

/// "c1/designs/d3/race?iteration=8": parameters in the order given, those without a value left out.
export function path_of(path: string, parameters: Record<string, string | number | null | undefined> = {}): string {
  const values = Object.entries(parameters)
    .filter(([, value]) => value !== null && value !== undefined && value !== "")
    .map(([name, value]) => `${name}=${encodeURIComponent(String(value))}`);
  return path + (values.length ? (path.includes("?") ? "&" : "?") + values.join("&") : "");
}

const kept = new Map<string, Kept>();
const kMostKept = 40;

async function fetched(path: string, init: RequestInit, patience_ms: number): Promise<Response> {
  const stop = new AbortController();
  const timer = setTimeout(() => stop.abort(), patience_ms);
  const headers = new Headers(init.headers);
  const secret = token();
  if (secret) headers.set("Authorization", "Bearer " + secret);
  try {
    return await fetch("api/v1/" + path, { ...init, headers, signal: stop.signal, credentials: "omit" });
  } catch {
    throw new ApiError(0, "unreachable", stop.signal.aborted
      ? `no answer within ${patience_ms / 1000} s` : "no answer: the process that serves this page cannot be reached", path);
  } finally {
    clearTimeout(timer);
  }
}

async function error_of(response: Response, path: string): Promise<ApiError> {
  try {
    const { error } = await response.json();
    return new ApiError(response.status, error.kind, error.message, error.where ?? "");
  } catch {
    return new ApiError(response.status, "http", `the server answered ${response.status} ${response.statusText}`, path);
  }
}

/// Text and data of a path below api/v1/. An answer that the server says is unchanged (ETag, 304)
/// is the very same object as before. Throws ApiError.
export async function ask(path: string, patience_ms = 65000): Promise<Answer> {
  if (is_snapshot) return from_snapshot(path);
  const before = kept.get(path);
  for (let attempt = 1; ; ++attempt) {
    const response = await fetched(path, before ? { headers: { "If-None-Match": before.etag } } : {}, patience_ms);
    const timing = /dur=([\d.]+)/.exec(response.headers.get("Server-Timing") ?? "");
    const cost_ms = timing ? Number(timing[1]) : 0;
    if (response.status === 304 && before) return { ...before, cost_ms };
    if (response.status === 503 && attempt < 4 && path !== "live") {  // others ask for heavy things, too
      await new Promise((done) => setTimeout(done, 1000 * Number(response.headers.get("Retry-After") ?? 1)));
      continue;
    }
    if (!response.ok) throw await error_of(response, path);
    let text: string;
    try { text = await response.text(); } catch { throw new ApiError(0, "unreachable", "the answer broke off", path); }
    const json = (response.headers.get("Content-Type") ?? "").includes("json");
    const data: unknown = json ? JSON.parse(text) : text;
    const etag = response.headers.get("ETag");
    kept.delete(path);
    if (etag) kept.set(path, { etag, text: json ? "" : text, data });
    if (kept.size > kMostKept) kept.delete(kept.keys().next().value as string);
    return { text, data, cost_ms };
  }
}

export async function get<T>(path: string): Promise<T> {
  return (await ask(path)).data as T;
}

/// An action. It needs the token; answers with the sentence of what was done. Throws ApiError.
export async function post(path: string): Promise<{ command: string; design?: string; done: string }> {
  const response = await fetched(path, { method: "POST" }, 15000);
  if (!response.ok) throw await error_of(response, path);
  return response.json();
}

// --- live numbers ---------------------------------------------------------------------------------

/// Asks for `live` once a second while the page is seen, and tells who listens.
class Feed {
  live: Live | null = null;
  at: Date | null = null;             ///< of the last answer
  failure: ApiError | null = null;    ///< of the last attempt
  next_try: Date | null = null;
  private listeners = new Set<() => void>();
  private timer = 0;
  private failures = 0;
  private asking = false;

  listen(what: () => void): () => void {
    this.listeners.add(what);
    return () => { this.listeners.delete(what); };
  }

  start(): void {
    document.addEventListener("visibilitychange", () => { if (!document.hidden) this.ask_now(); });
    this.ask_now();
  }

  /// True while the numbers on the page are not those of now.
  get stale(): boolean { return this.failure !== null; }

  ask_now(): void {
    clearTimeout(this.timer);
    if (!this.asking) void this.turn();
  }

  private async turn(): Promise<void> {
    this.asking = true;
    try {
      const live = (await ask("live", 3000)).data as Live;
      if (this.live && live.boot !== this.live.boot) restarted();
      this.live = live;
      this.at = new Date();
      this.failure = null;
      this.failures = 0;
    } catch (error) {
      this.failure = error as ApiError;
      ++this.failures;
    }
    this.asking = false;
    const waits = [1, 2, 4, 8, 15];
    const wait_s = this.failure ? waits[Math.min(this.failures, waits.length) - 1]
      : document.hidden ? 30 : this.live?.running ? 1 : 5;
    this.next_try = this.failure ? new Date(Date.now() + 1000 * wait_s) : null;
    if (!is_snapshot) this.timer = window.setTimeout(() => this.ask_now(), 1000 * wait_s);
    this.tell();
  }

  private tell(): void { this.listeners.forEach((listener) => listener()); }
}

/// Another process answers at this address: all that is kept is of the one before.
function restarted(): void {
  sessionStorage.setItem("notice", `Another process answers at this address since ${new Date().toLocaleTimeString("en-GB")}: `
    + "this page was loaded again, and these are its numbers.");
  location.reload();
}

export const feed = new Feed();
