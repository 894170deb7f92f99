#pragma once

#include <string>
#include <string_view>

#include "base/expected.h"
#include "cli/dashboard/answer_cache.h"
#include "cli/dashboard/question.h"
#include "coordinator/service/http_site.h"

namespace swarmsmith::cli {

/// Answers and pages as HTTP responses: status, headers, compression. Pure.

/// {"v":1,"error":{"kind":...,"message":...,"where":...}}.
std::string error_text(std::string_view kind, std::string_view message, std::string_view where);

/// An answer or an error, compressed for the cache; computing it took `seconds`.
KeptAnswer kept_of(const Expected<Answer>& answer, double seconds);

/// Whether the program has a page at this path.
bool has_page(std::string_view path);
/// The page, or 404 if there is none.
SiteAnswer page_response(const SiteRequest& request);
/// The response with an answer of the API.
SiteAnswer data_response(const SiteRequest& request, const KeptAnswer& kept);
/// Status 202: the progress of the computation, and the address to ask again, which is the same
/// one.
SiteAnswer not_yet_response(const SiteRequest& request, const AnswerCache::SoFar& so_far);

}  // namespace swarmsmith::cli
