import { Component, h, render } from "preact";

/** What is known of the campaigns, or why nothing is. */
interface State {
  text: string;
}

class App extends Component<{}, State> {
  state: State = { text: "loading" };

  async componentDidMount() {
    try {
      const answer = await fetch("api/v1/live");
      this.setState({ text: JSON.stringify(await answer.json(), null, 1) });
    } catch (error) {
      this.setState({ text: "no answer: " + error });
    }
  }

  render() {
    return <pre>{this.state.text}</pre>;
  }
}

const place = document.getElementById("app")!;
place.textContent = "";
render(<App />, place);
