#pragma once

#include <string>
#include <string_view>

#include "base/expected.h"
#include "cli/dashboard/answer_cache.h"
#include "cli/dashboard/question.h"
#include "coordinator/service/http_site.h"

namespace swarmsmith::cli {

/// Answers and pages as HTTP: status, headers, compression. Pure.

/// {"v":1,"error":{"kind":...,"message":...,"where":...}}.
std::string error_text(std::string_view kind, std::string_view message, std::string_view where);

/// An answer or an error, packed for the cache; it took `seconds`.
KeptAnswer kept_of(const Expected<Answer>& answer, double seconds);

/// Whether the program has a page of this path.
bool has_page(std::string_view path);
/// A page; 404 if there is none.
SiteAnswer page_response(const SiteRequest& request);
/// An answer of the API.
SiteAnswer data_response(const SiteRequest& request, const KeptAnswer& kept);
/// 202: how far it is, and where to ask again, which is the same address.
SiteAnswer not_yet_response(const SiteRequest& request, const AnswerCache::SoFar& so_far);

}  // namespace swarmsmith::cli
