import { Component, h } from "preact";
import { ApiError, ask, feed, path_of, Pending } from "./api";
import { Empty, Failure, Waiting } from "./components";

interface Props<T> {
  /// The path below api/v1/.
  path: string;
  /// The path is fetched again when this changes, such as the version of a design, but not so often
  /// that a viewer costs more than a twentieth of a core.
  version?: string | number;
  /// Number of seconds after which it is fetched again, too.
  every_s?: number;
  /// For answers whose columns only grow, ordered by this column: then only the values after its
  /// last one are fetched.
  grows?: string;
  /// Keeps showing the answer of the previous path until the new one arrives: for sliders.
  keep?: boolean;
  render: (data: T) => JSX.Element | (JSX.Element | false | null)[] | null;
  /// Shown instead of the server's message if there is nothing (404).
  missing?: JSX.Element;
}

interface State { path?: string; data?: unknown; error?: ApiError; pending?: Pending }

/// Maximum number of rows; longer columns are fetched as a whole, because the server may have
/// thinned them out.
const kMostGrown = 5000;

type Lists = Record<string, any>;

/// The columns with the new rows added; the same object if there are none.
export function grown(before: Lists, more: Lists, by: string): Lists {
  return more[by].length === 0 ? before : Object.fromEntries(Object.entries(more).map(([name, one]) => [name, Array.isArray(one) ? before[name].concat(one) : one]));
}

/// Shows the server's answer at a path, drawn by `render`, and keeps it up to date.
export class Get<T> extends Component<Props<T>, State> {
  #started = 0;
  #cost_ms = 0;
  #timer = 0;
  #is_gone = false;
  #deaf = () => {};
  #was_stale = false;

  componentDidMount() {
    this.#load();
    this.#deaf = feed.listen(() => {
      if (this.#was_stale && !feed.stale && this.state.error?.unreachable) this.#load();
      this.#was_stale = feed.stale;
    });
  }
  componentWillUnmount() {
    this.#is_gone = true;
    clearTimeout(this.#timer);
    this.#deaf();
  }
  componentDidUpdate(before: Props<T>) {
    if (before.path !== this.props.path) this.#load();
    else if (before.version !== this.props.version) this.#load_later(Math.max(2000, 20 * this.#cost_ms));
  }

  #load_later(pause_ms: number) {
    clearTimeout(this.#timer);
    this.#timer = window.setTimeout(this.#load, Math.max(0, this.#started + pause_ms - Date.now()));
  }

  #load = async () => {
    clearTimeout(this.#timer);
    this.#started = Date.now();
    const { path, grows } = this.props;
    const before = this.state.path === path ? this.state.data as Lists : undefined;
    if (before && document.hidden) return this.#load_later(1000);
    const list = grows && before?.[grows], last = list?.length < kMostGrown ? list[list.length - 1] : undefined;
    let next: State;
    try {
      const { data: got, cost_ms } = await ask(last === undefined ? path : path_of(path, { after: last }), undefined, (pending) => {
        if (!this.#is_gone && path === this.props.path) this.setState({ pending });
      });
      this.#cost_ms = cost_ms;
      const data = last === undefined ? got : grown(before!, got as Lists, grows!);
      // "Nothing yet" is a normal answer, because browsers complain about every failed request.
      const { nothing } = data as { nothing?: string };
      if (nothing !== undefined) throw new ApiError(404, nothing);
      next = { path, data, error: undefined, pending: undefined };
    } catch (error) {
      next = { path, error: error as ApiError, pending: undefined, ...(this.state.path !== path && { data: undefined }) };
    }
    if (this.#is_gone || path !== this.props.path) return;
    this.setState(next);
    if (this.props.every_s) this.#load_later(1000 * this.props.every_s);
  };

  /// An answer of another version may lack data that the page needs; the rest of the page must
  /// still work.
  #drawn(data: T) {
    try { return this.props.render(data) as JSX.Element; } catch (error) {
      console.error(error);
      return <Failure error={new ApiError(-1, `the page cannot show this answer: ${(error as Error).message}`, this.props.path)} />;
    }
  }

  render({ path: wanted, keep, missing }: Props<T>, { path, data, error, pending }: State) {
    const is_current = path === wanted;
    const failure = error ? <Failure error={error} again={this.#load} /> : null;
    if (is_current && error && data === undefined)
      return error.status === 404 ? missing ?? <Empty>{error.message}</Empty> : failure;
    if (data === undefined || !is_current && !keep) return <Waiting pending={pending} />;
    return <div class={is_current ? "" : "old"} aria-busy={is_current ? undefined : "true"}>{failure}{this.#drawn(data as T)}</div>;
  }
}
