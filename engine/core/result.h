#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace dollytrack {

/// What went wrong, in kinds that a caller can act on. Each maps onto one exit code.
enum class ErrorCode { Failed, Usage, BadInput, NoOpenGl, CannotWrite, Cancelled };

/// A failure of the outside world: one sentence for the user, and where.
struct Error {
    ErrorCode code = ErrorCode::Failed;
    std::string message;  // one sentence, says what to do
    std::string where;    // "flat.obj:12", "fill", or empty
};

template <class T>
using Result = tl::expected<T, Error>;
using Status = Result<void>;

[[nodiscard]] inline tl::unexpected<Error> fail(ErrorCode code, std::string message,
                                                std::string where = {}) {
    return tl::unexpected(Error{code, std::move(message), std::move(where)});
}

/// "where: message", or the message alone.
[[nodiscard]] inline std::string describe(const Error& error) {
    return error.where.empty() ? error.message : error.where + ": " + error.message;
}

}  // namespace dollytrack
