#pragma once

/// The names of messages alone: to include the generated code takes as long as to compile a small
/// file.
namespace swarmsmith::pb {

class Command;
class Heartbeat;
class Hello;
class Reject;
class Results;
class Returned;
class ScenarioReply;
class Tasks;
class ToCoordinator;
class ToWorker;
class Welcome;
enum Command_Kind : int;

}  // namespace swarmsmith::pb
