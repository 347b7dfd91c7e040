/// Keeps a host apart from the judge and from other hosts: by a user id of its own, by capabilities, by filters.
/// docs/explanation/threat-model.md says which of them hold where.
#pragma once

#include <sys/types.h>

#include <optional>
#include <span>
#include <string>

namespace nearmiss {

/// A user id for one host, to which no user of the system and no other host of this process belongs. Empty where this
/// process is not the superuser, where it may not change ids and signal other users, or where its user namespace has no
/// such id.
std::optional<uid_t> user_for_a_host();

/// What a line says where such a user cannot reach a file that is needed.
inline std::string advice_about_unreachable(const std::string& file) {
  return "nearmiss runs as the superuser, and what it asks as a user of its own, who cannot read " + file +
         ": let every user read it and its folders, or run nearmiss as an ordinary user";
}

/// Gives up all capabilities, and every way to get them back with a program that it starts. With a user, changes user
/// and group of this process to it and leaves all other groups. Returns 0 or an errno.
int become_unprivileged(std::optional<uid_t> user);

/// Opens a file with the rights of this process, so that after a change of user it can be read and executed through
/// its descriptor: a copy in memory where the file's own mode forbids that to other users. -1 and errno where this
/// process cannot read it.
int open_for_other_users(const char* file);

/// Makes the system refuse to this process, and to all that it starts, to signal, limit or slow down the given
/// processes and process groups, and to signal all processes at once. Where the system knows Landlock's scopes
/// (Linux 6.12), this process can besides neither signal nor trace any process but those that it starts. Only for a
/// process that has the same user as these; it must have no_new_privs. Programs for another processor mode (32 bits) do
/// not run afterwards.
void shield(std::span<const pid_t> processes);

}  // namespace nearmiss
