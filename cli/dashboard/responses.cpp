#include "cli/dashboard/responses.h"

#include <fmt/format.h>

#include "base/hash.h"
#include "base/text/gzip.h"
#include "base/text/json.h"
#include "web/pages.h"

namespace swarmsmith::cli {
namespace {

constexpr std::size_t kMostUnpacked = std::size_t{256} << 20U;

constexpr const char* kPagePolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
/// For everything except pages: figures contain their own styles, and nothing else is allowed.
constexpr const char* kDataPolicy =
    "default-src 'none'; style-src 'unsafe-inline'; frame-ancestors 'none'; sandbox";

constexpr const char* kNoPages =
    "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>Swarmsmith</title>"
    "<p>This program was built without its pages: where it was built, esbuild, node-preact or "
    "zopfli was not installed. What they show is below <a href=\"api/v1/live\">api/v1/live</a> "
    "as JSON (docs/http-api.md).</p></html>\n";

int status_of(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::BadInput:
      return 400;
    case ErrorKind::NotFound:
      return 404;
    case ErrorKind::Conflict:
    case ErrorKind::Corrupt:
    case ErrorKind::Newer:
      return 409;
    case ErrorKind::Unavailable:
      break;
  }
  return 503;
}

const char* word_of_kind(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::BadInput:
      return "bad_input";
    case ErrorKind::NotFound:
      return "not_found";
    case ErrorKind::Conflict:
      return "conflict";
    case ErrorKind::Corrupt:
      return "corrupt";
    case ErrorKind::Newer:
      return "newer";
    case ErrorKind::Unavailable:
      break;
  }
  return "unavailable";
}

std::string etag_of(std::string_view type, std::string_view bytes) {
  Digest digest;
  digest.add(type);
  digest.add(bytes);
  return fmt::format("\"{:016x}\"", digest.value64());
}

const PageFile* find_page(std::string_view path) {
  for (const PageFile& file : page_files())
    if (file.path == path) return &file;
  return nullptr;
}

/// The response in a form that the client accepts: 304 if the client has it already, compressed if
/// the client can decompress it.
SiteAnswer outgoing(const SiteRequest& request, const KeptAnswer& kept, const char* policy) {
  SiteAnswer answer{.status = kept.status, .type = kept.type, .body = {}};
  answer.headers.emplace_back("Content-Security-Policy", policy);
  answer.headers.emplace_back("Vary", "Accept-Encoding");
  if (!kept.etag.empty()) answer.headers.emplace_back("ETag", kept.etag);
  if (!kept.etag.empty() && request.etag.find(kept.etag) != std::string::npos) {
    answer.status = 304;
    return answer;
  }
  if (request.accepts_gzip) {
    answer.headers.emplace_back("Content-Encoding", "gzip");
    answer.body = kept.packed;
  } else {
    answer.body = gunzip(kept.packed, kMostUnpacked).value_or("");
  }
  return answer;
}

std::string as_in_address(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '-' || c == '_' || c == '.';
    escaped += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return escaped;
}

}  // namespace

std::string error_text(std::string_view kind, std::string_view message, std::string_view where) {
  return answer_object()
             .add("error",
                  JsonObject().add("kind", kind).add("message", message).add("where", where))
             .text() +
         "\n";
}

KeptAnswer kept_of(const Expected<Answer>& answer, double seconds) {
  KeptAnswer kept;
  kept.seconds = seconds;
  if (answer) {
    kept.type = answer->type;
    kept.packed = gzip(answer->body);
    kept.etag = etag_of(answer->type, answer->body);
    kept.is_final = answer->is_final;
    return kept;
  }
  const Error& error = answer.error();
  kept.status = status_of(error.kind);
  kept.type = "application/json";
  kept.packed = gzip(error_text(word_of_kind(error.kind), error.message, error.where));
  kept.is_good = false;
  return kept;
}

bool has_page(std::string_view path) {
  return find_page(path) != nullptr;
}

SiteAnswer page_response(const SiteRequest& request) {
  const PageFile* file = find_page(request.path);
  if (file != nullptr) {
    KeptAnswer kept{.type = std::string(file->type),
                    .packed = std::string(file->packed),
                    .etag = etag_of(file->type, file->packed)};
    return outgoing(request, kept, kPagePolicy);
  }
  const bool is_start = request.path == "/";
  SiteAnswer answer{.status = is_start ? 200 : 404,
                    .type = is_start ? "text/html; charset=utf-8" : "text/plain",
                    .body = is_start ? kNoPages : "there is no such page\n"};
  answer.headers.emplace_back("Content-Security-Policy", kPagePolicy);
  return answer;
}

SiteAnswer data_response(const SiteRequest& request, const KeptAnswer& kept) {
  return outgoing(request, kept, kDataPolicy);
}

SiteAnswer not_yet_response(const SiteRequest& request, const AnswerCache::SoFar& so_far) {
  std::string place = request.path;
  for (const auto& [name, value] : request.parameters)
    place += (place.size() == request.path.size() ? '?' : '&') + as_in_address(name) + '=' +
             as_in_address(value);
  const std::string body =
      answer_object()
          .add("pending", JsonObject()
                              .add("state", so_far.goes_on ? "computing" : "waiting")
                              .add("seconds", so_far.seconds)
                              .add("place", place))
          .text() +
      "\n";
  SiteAnswer answer = outgoing(
      request, {.status = 202, .type = "application/json", .packed = gzip(body), .etag = {}},
      kDataPolicy);
  answer.headers.emplace_back("Location", place);
  answer.headers.emplace_back("Retry-After", "1");
  return answer;
}

}  // namespace swarmsmith::cli
