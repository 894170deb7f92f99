#pragma once

#include <string>

#include "base/hash.h"
#include "storage/rows.h"

namespace swarmsmith {

/// Whether a row is part of the campaign's answer: the rows that are the same for any number of
/// workers, any order in which results arrive, and any history of crashes. Rows about workers,
/// conflicts, events and the campaign's state are not part of it. Neither are look-ahead
/// evaluations, audits, later scores and evaluations that the race did not need, nor the worker,
/// attempt and wall time of an evaluation that is part of it.
bool in_answer(const Row& row);

/// Whether both rows have the same type, and the same bits in every field that is part of the
/// answer. (-0 equals 0: SQLite does not keep its sign.)
bool same_answer(const Row& a, const Row& b);

/// Adds the fields of the row that are part of the answer; adds nothing if there are none.
void add_answer(Digest& digest, const Row& row);

/// One line for messages: "evaluation e100003: candidate=c1 pair=3 status=0 score=2.5 ...", with
/// the fields that are part of the answer. Long texts are cut, and end with a digest of the whole
/// text, so that different rows always have different descriptions.
std::string describe(const Row& row);

/// The id of an evaluation that users see: e<candidate * 100,000 + pair>, followed by a letter if
/// the evaluation was not made for a race (PurposeFacts::letter). (Column `id` of v_evaluations.)
std::string to_string(const EvaluationKey& key);

}  // namespace swarmsmith
