import { Component, h } from "preact";
import { ApiError, ask, feed } from "./api";
import { Failure, Waiting } from "./components";

interface Props<T> {
  /// Below api/v1/.
  path: string;
  /// Asked anew when it changes, such as the version of a design; but so seldom that a viewer costs
  /// at most a twentieth of a core.
  version?: string | number;
  /// Also asked every so many seconds.
  every_s?: number;
  /// Shows the answer of the path before while the new one is on its way: for sliders.
  keep?: boolean;
  render: (data: T, text: string) => JSX.Element | null;
  /// In place of a sentence of the server when there is nothing (404).
  missing?: (error: ApiError) => JSX.Element;
}

interface State { path: string; data: unknown; text: string; error: ApiError | null }

/// What the server says to a path, drawn by `render`, and renewed.
export class Get<T> extends Component<Props<T>, State> {
  state: State = { path: "", data: undefined, text: "", error: null };
  private started = 0;
  private cost_ms = 0;
  private timer = 0;
  private gone = false;
  private deaf = () => {};
  private was_stale = false;

  componentDidMount() {
    this.load();
    this.deaf = feed.listen(() => {
      if (this.was_stale && !feed.stale && this.state.error?.unreachable) this.load();
      this.was_stale = feed.stale;
    });
  }
  componentWillUnmount() {
    this.gone = true;
    clearTimeout(this.timer);
    this.deaf();
  }
  componentDidUpdate(before: Props<T>) {
    if (before.path !== this.props.path) this.load();
    else if (before.version !== this.props.version) this.load_later(Math.max(2000, 20 * this.cost_ms));
  }

  private load_later(pause_ms: number) {
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => this.load(), Math.max(0, this.started + pause_ms - Date.now()));
  }

  load = async () => {
    clearTimeout(this.timer);
    this.started = Date.now();
    const path = this.props.path;
    let next: Partial<State> = {};
    try {
      const answer = await ask(path);
      this.cost_ms = answer.cost_ms;
      // "Nothing yet" is an answer: browsers complain of every request that fails.
      const { nothing } = answer.data as { nothing?: string };
      if (nothing !== undefined) throw new ApiError(404, "nothing", nothing);
      next = { path, data: answer.data, text: answer.text, error: null };
    } catch (error) {
      next = this.state.path === path ? { error: error as ApiError } : { path, data: undefined, text: "", error: error as ApiError };
    }
    if (this.gone || path !== this.props.path) return;
    this.setState(next as State);
    if (this.props.every_s) this.load_later(1000 * this.props.every_s);
  };

  /// An answer of another version may lack what the page needs: the rest of the page stays.
  private drawn(data: T, text: string) {
    try { return this.props.render(data, text); } catch (error) {
      console.error(error);
      return <Failure error={new ApiError(-1, "page", `the page cannot show this answer: ${(error as Error).message}`, this.props.path)} />;
    }
  }

  render() {
    const { path, data, text, error } = this.state;
    const current = path === this.props.path;
    if (current && error && data === undefined)
      return error.status === 404 && this.props.missing ? this.props.missing(error) : <Failure error={error} again={this.load} />;
    if (data === undefined || !current && !this.props.keep) return <Waiting />;
    return <div class={current ? "got" : "got old"} aria-busy={current ? undefined : "true"}>
      {error && <Failure error={error} again={this.load} />}
      {this.drawn(data as T, text)}
    </div>;
  }
}
