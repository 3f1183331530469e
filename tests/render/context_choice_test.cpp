#include "render/gl/context_choice.h"

#include <gtest/gtest.h>

#include <vector>

namespace dollytrack::gl::context_choice_test {
namespace {

class NamedContext final : public Context {
  public:
    explicit NamedContext(std::string called) : name(std::move(called)) {}
    Status makeCurrent() override { return {}; }
    std::string name;
};

class ContextChoices : public testing::Test {
  protected:
    ContextChoice choice(const std::string& name, bool works) {
        return {name, [this, name, works]() -> Result<std::unique_ptr<Context>> {
                    tried_.push_back(name);
                    if (works) return std::make_unique<NamedContext>(name);
                    return fail(ErrorCode::NoOpenGl, name + " is broken");
                }};
    }
    std::vector<std::string> tried_;
};

TEST_F(ContextChoices, GoOnToTheFirstThatOpens) {
    const std::vector<ContextChoice> choices = {choice("first", false), choice("second", true),
                                                choice("third", true)};
    const auto opened = openFirst(choices);
    ASSERT_TRUE(opened);
    EXPECT_EQ(dynamic_cast<const NamedContext&>(**opened).name, "second");
    EXPECT_EQ(tried_, (std::vector<std::string>{"first", "second"}));
}

TEST_F(ContextChoices, TellAllThatWereTriedAndWhy) {
    const std::vector<ContextChoice> choices = {choice("first", false), choice("second", false)};
    const auto opened = openFirst(choices);
    ASSERT_FALSE(opened);
    EXPECT_EQ(opened.error().code, ErrorCode::NoOpenGl);
    EXPECT_NE(opened.error().message.find("tried: first (first is broken), "
                                          "second (second is broken)"),
              std::string::npos)
        << opened.error().message;
    EXPECT_FALSE(openFirst({}));
}

}  // namespace
}  // namespace dollytrack::gl::context_choice_test
