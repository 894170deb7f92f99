#include "proto/access/allow_list_file.h"

#include <sys/stat.h>
#include <string>
#include <utility>

#include "proto/access/secret_file.h"

namespace swarmsmith {
namespace {

AllowListOrErrors read_allow_list(const std::filesystem::path& file) {
  Expected<std::string> text = read_private_file(file, "list of clients", Privacy::Integral);
  if (text) return parse_allow_list(*text, file.string());
  Error error = text.error();
  if (error.kind == ErrorKind::NotFound) {
    error.message +=
        "; `swarmsmith keygen " + file.parent_path().string() + "` makes one, with keys";
  }
  return tl::unexpected(std::vector<Error>{std::move(error)});
}

}  // namespace

AllowListFile::Stamp AllowListFile::stamp_of(const std::filesystem::path& file) {
  struct stat status = {};
  if (stat(file.c_str(), &status) != 0) return {};
  return {status.st_mtim.tv_sec, status.st_mtim.tv_nsec, status.st_ino, status.st_size};
}

tl::expected<AllowListFile, std::vector<Error>> AllowListFile::open(
    const std::filesystem::path& file, std::chrono::sys_seconds now) {
  AllowListFile opened;
  opened.file_ = file;
  // Taken before reading: a change in between is seen the next time.
  opened.stamp_ = stamp_of(file);
  AllowListOrErrors list = read_allow_list(file);
  if (!list) return tl::unexpected(std::move(list.error()));
  opened.list_ = std::move(*list);
  opened.clients_ = clients_at(opened.list_, now);
  return opened;
}

AllowListFile::Look AllowListFile::look(std::chrono::sys_seconds now, bool anyway) {
  Look look;
  const Stamp stamp = stamp_of(file_);
  if (anyway || stamp != stamp_) {
    stamp_ = stamp;
    AllowListOrErrors list = read_allow_list(file_);
    if (list) {
      list_ = std::move(*list);
    } else {
      look.faults = std::move(list.error());
    }
  }
  // Keys expire even if the file does not change.
  std::vector<ListedClient> clients = clients_at(list_, now);
  look.changed = clients != clients_;
  clients_ = std::move(clients);
  return look;
}

}  // namespace swarmsmith
