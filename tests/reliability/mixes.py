"""What hostile peers do, by name: words of the program `hostile`. None of them may change anything."""

#: Strangers without a key.
MIXES = {
    "strays": "leaves alone,leaves with leases",
    "rejections": "rejects",
    "failures": "fails",
    "guesses": "guesses",
    "claims": "claims leases",
    "replays": "replays",
    "nonsense": "talks nonsense",
    "floods": "floods",
    "any order": "talks at random",
    "crowd": "leaves alone,rejects,fails,guesses,claims leases,replays,talks nonsense,"
             "talks at random,floods,leaves with leases",
}
#: Peers that have a listed key.
LIES = {
    "liars": "lies",
    "liars who change their names": "renames",
    # Twenty lies a message.
    "liars with guessed keys": "lies,guesses,guesses,guesses,guesses",
}
