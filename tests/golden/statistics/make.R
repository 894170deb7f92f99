# Makes statistics.json: random samples, and what R says about them. Base R alone.
#   Rscript make.R [OUTPUT] [SEED] [TIED] [UNTIED]
arguments <- commandArgs(TRUE)
output <- if (length(arguments) > 0) arguments[1] else "statistics.json"
seed <- if (length(arguments) > 1) as.integer(arguments[2]) else 6L
tied <- if (length(arguments) > 2) as.integer(arguments[3]) else 200L
untied <- if (length(arguments) > 3) as.integer(arguments[4]) else 100L
set.seed(seed, kind = "Mersenne-Twister", normal.kind = "Inversion", sample.kind = "Rejection")

number <- function(v) ifelse(is.finite(v), sprintf("%.15g", v), "null")
numbers <- function(v) paste0("[", paste(number(v), collapse = ","), "]")
rows <- function(m) paste0("[", paste(apply(m, 1, numbers), collapse = ","), "]")
object <- function(...) {
  parts <- list(...)
  paste0("{", paste0("\"", names(parts), "\":", unlist(parts), collapse = ","), "}")
}
text <- function(s) paste0("\"", s, "\"")

wilcoxon <- function(x, y, paired) {
  ask <- function(alternative) {
    suppressWarnings(wilcox.test(x, y, paired = paired, alternative = alternative))
  }
  two <- ask("two.sided")
  object(statistic = number(two$statistic), p = number(two$p.value),
         greater = number(ask("greater")$p.value), less = number(ask("less")$p.value),
         method = text(trimws(two$method)))
}

# Mean ranks with the intervals whose overlap says "not significant": Conover 1999, section 5.8.
# The largest value of a block has rank 1.
friedman <- function(values) {
  ranks <- t(apply(-values, 1, rank))
  b <- nrow(values)
  k <- ncol(values)
  sums <- colSums(ranks)
  freedom <- (b - 1) * (k - 1)
  spread <- max(0, 2 * (b * sum(ranks^2) - sum(sums^2)) / freedom)
  half <- if (b > 1) qt(0.975, freedom) * sqrt(spread) / (2 * b) else NaN
  # With one block R's function loses the shape of its matrix.
  test <- if (b > 1) friedman.test(values) else list(statistic = NaN, p.value = NaN)
  object(statistic = number(test$statistic), p = number(test$p.value),
         mean_ranks = numbers(sums / b), half_width = number(half))
}

a12 <- function(x, y) mean(outer(x, y, ">") + 0.5 * outer(x, y, "=="))

# Percentile intervals of 40 bootstraps, their mean and how much one of them varies.
bootstrap <- function(x, y, paired) {
  once <- function() {
    d <- if (paired) replicate(10000, mean(sample(x - y, replace = TRUE)))
         else replicate(10000, mean(sample(x, replace = TRUE)) - mean(sample(y, replace = TRUE)))
    quantile(d, c(0.025, 0.975), names = FALSE)
  }
  many <- replicate(40, once())
  object(value = number(mean(x) - mean(y)), low = number(mean(many[1, ])),
         low_sd = number(sd(many[1, ])), high = number(mean(many[2, ])),
         high_sd = number(sd(many[2, ])))
}

parts <- c(0, 0.025, 0.1, 0.25, 0.5, 0.75, 0.975, 1)

# Scores as missions have them: robots on a spot, at most `most`; one sample tends to be larger.
integers <- function(n, most, chance) rbinom(n, most, chance)
# No two values are the same, nor two differences.
reals <- function(n, shift) {
  repeat {
    v <- round(rnorm(n, shift, 2), 6)
    if (!anyDuplicated(v)) return(v)
  }
}

data_set <- function(name, with_ties) {
  sizes <- c(sample(1:60, 1), sample(1:60, 1))
  if (runif(1) < 0.4) sizes <- sample(3:12, 2, replace = TRUE)  # as many as papers have
  n <- if (runif(1) < 0.5) sample(1:15, 1) else sample(1:70, 1)
  b <- sample(2:30, 1)
  k <- sample(2:7, 1)
  if (with_ties) {
    most <- sample(c(1, 3, 6, 20, 400), 1)
    chances <- runif(2, 0.1, 0.9)
    if (runif(1) < 0.5) chances[2] <- chances[1]
    x <- integers(sizes[1], most, chances[1])
    y <- integers(sizes[2], most, chances[2])
    before <- integers(n, most, chances[1])
    after <- integers(n, most, chances[2])
    blocks <- matrix(integers(b * k, most, rep(runif(k, 0.3, 0.7), each = b)), b, k)
  } else {
    x <- reals(sizes[1], 0)
    y <- reals(sizes[2], runif(1, -2, 2))
    before <- reals(n, 0)
    after <- reals(n, runif(1, -2, 2))
    blocks <- matrix(reals(b * k, 0) + rep(runif(k, -1, 1), each = b), b, k)
    blocks <- round(blocks, 9)
  }
  describe(name, with_ties, x, y, before, after, blocks, runif(1) < 0.06)
}

describe <- function(name, with_ties, x, y, before, after, blocks, resample) {
  p <- round(runif(sample(1:12, 1))^2, 4)
  if (length(p) > 3) p[2] <- p[1]
  fields <- list(
    name = text(name), ties = tolower(with_ties), x = numbers(x), y = numbers(y),
    before = numbers(before), after = numbers(after), blocks = rows(blocks),
    mean = number(mean(x)), sd = number(if (length(x) > 1) sd(x) else NaN),
    quantiles = numbers(quantile(x, parts, names = FALSE)),
    rank_sum = wilcoxon(x, y, FALSE), signed_rank = wilcoxon(before, after, TRUE),
    friedman = friedman(blocks), a12 = number(a12(x, y)),
    p_values = numbers(p), holm = numbers(p.adjust(p, "holm")))
  if (resample && min(length(x), length(y), length(before)) > 5) {
    fields$bootstrap <- bootstrap(x, y, FALSE)
    fields$paired_bootstrap <- bootstrap(before, after, TRUE)
  }
  do.call(object, fields)
}

# What random samples hardly ever are.
corners <- c(
  describe("everything tied", TRUE, c(3, 3, 3), c(3, 3), c(1, 2), c(1, 2), matrix(5, 4, 3), FALSE),
  describe("one value each", TRUE, 1, 2, 4, 4, matrix(c(1, 2), 1, 2), FALSE),
  describe("one value each, apart", FALSE, 2, 1, 4, 3, matrix(c(1, 2, 3), 1, 3), FALSE),
  describe("49 without ties", FALSE, 1:49, 100:148 / 2, (1:49)^2, rep(0.5, 49),
           matrix(1:12, 4, 3), FALSE),
  describe("50 without ties", FALSE, 1:50, 100:148 / 2, (1:50)^2, rep(0.5, 50),
           matrix(12:1, 4, 3), FALSE),
  describe("far apart", TRUE, c(rep(0, 55), 1), rep(9, 60), rep(0, 60), 9 + rep(0:1, 30),
           matrix(rep(1:5, each = 30), 30, 5), FALSE))

sets <- c(corners,
          sapply(seq_len(tied), function(i) data_set(paste("tied", i), TRUE)),
          sapply(seq_len(untied), function(i) data_set(paste("untied", i), FALSE)))
lines <- c("{", paste0("\"r\":", text(R.version.string), ","),
           paste0("\"parts\":", numbers(parts), ","), "\"sets\":[",
           paste0(sets, c(rep(",", length(sets) - 1), "")), "]}")
writeLines(lines, output)
