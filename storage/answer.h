#pragma once

#include <string>

#include "base/hash.h"
#include "storage/rows.h"

namespace swarmsmith {

/// What of a store is the campaign's answer: the part that is the same for any number of workers,
/// any order of arrival and any history of crashes. Rows of workers, conflicts, events and of the
/// campaign's state are not part of it, nor are look-aheads, audits, later scorings and evaluations
/// that the race did not want; nor worker, attempt and wall time of the evaluations that are.
bool in_answer(const Row& row);

/// Whether both rows are of one kind and agree, bit by bit, in all that is part of the answer.
/// (-0 counts as 0: SQLite does not keep its sign.)
bool same_answer(const Row& a, const Row& b);

/// Adds the parts of the row that belong to the answer; nothing when none does.
void add_answer(Digest& digest, const Row& row);

/// One line for messages: "evaluation e100003: candidate=c1 pair=3 status=0 score=2.5 ...", with
/// the fields that are part of the answer. Long texts are cut, and end with a digest of the whole,
/// so that rows which differ have descriptions which differ.
std::string describe(const Row& row);

/// How people see an evaluation: e<candidate * 100,000 + pair>, and a letter after it when it was
/// not made for a race (PurposeFacts::letter). (Column `id` of v_evaluations.)
std::string to_string(const EvaluationKey& key);

}  // namespace swarmsmith
