#pragma once

/// Only the names of the messages: including the generated code takes as long as compiling a small
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
