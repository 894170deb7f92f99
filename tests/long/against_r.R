# The same cases as irace_rules, answered by R itself and by functions of its irace, 3.5 or 4.2. Reads a file of cases,
# prints a line a case.
#
#   Rscript against_r.R CASES
suppressPackageStartupMessages(library(irace))
options(warn = -1)

# Some functions have other names and parameters in irace 4.
is_4 <- packageVersion("irace") >= "4"
of_irace <- function(name, name_in_4 = name) get(if (is_4) name_in_4 else name, asNamespace("irace"))

# The sums of irace 4 make means differ in their last bit that are equal, and the smaller one is taken for the best: here
# they are R's own.
ttest <- of_irace("aux.ttest")
if (is_4) environment(ttest) <- list2env(list(colMeans2 = function(x, cols, useNames) colMeans(x[, cols])),
                                         parent = asNamespace("irace"))

text <- function(x) paste(ifelse(is.na(x), "NA", sprintf("%.17g", as.numeric(x))), collapse = " ")
numbers <- function(words) suppressWarnings(as.numeric(words))
costs_of <- function(words, n, k) matrix(numbers(words), nrow = n, ncol = k, byrow = TRUE)

# Beside irace's own function, the plain test of base R gives the same p-value.
check_p <- function(p, other) {
  if (!isTRUE(all.equal(p, other, tolerance = 1e-9))) stop("irace and base R differ: ", p, " ", other)
  p
}

eliminate <- function(w) {
  type <- w[1]; confidence <- numbers(w[2]); n <- numbers(w[3]); k <- numbers(w[4])
  y <- costs_of(w[-(1:4)], n, k)
  alive <- rep(TRUE, k)
  if (type == "f") {
    found <- irace:::aux_friedman(y, alive, seq_len(k), confidence)
    if (k == 2 && found$p.value > 0)
      check_p(found$p.value, wilcox.test(y[, 1], y[, 2], paired = TRUE)$p.value)
    if (k > 2 && !is.nan(found$p.value)) check_p(found$p.value, friedman.test(y)$p.value)
  } else {
    found <- ttest(y, alive, seq_len(k), confidence, adjust = type)
  }
  text(c(found$p.value, as.numeric(found$alive)))
}

agreement <- function(w) {
  y <- costs_of(w[-(1:2)], numbers(w[1]), numbers(w[2]))
  found <- irace:::concordance(y)
  text(c(found$kendall.w, found$spearman.rho, irace:::dataVariance(y)))
}

overall <- function(w) {
  y <- costs_of(w[-(1:3)], numbers(w[2]), numbers(w[3]))
  text(of_irace("overall.ranks", "overall_ranks")(y, if (w[1] == "f") "friedman" else "t.none"))
}

race_size <- function(w) {
  v <- numbers(w)
  size <- of_irace("computeNbConfigurations")
  if (is_4) return(text(size(v[1], v[2], v[3], v[4], 1, v[5], v[6], v[7])))  # blocks of one
  text(size(v[1], v[2], v[3], v[4], v[5], v[6], v[7]))
}

minimum <- function(w) {
  v <- numbers(w)
  scenario <- list(elitist = v[1] != 0, mu = v[4], firstTest = 1, eachTest = v[5], elitistNewInstances = v[6])
  budget <- of_irace("computeMinimumBudget")
  if (is_4) return(text(budget(c(scenario, blockSize = 1), v[3], v[2], v[6])))
  text(budget(scenario, v[3], v[2], NULL))
}

update <- function(w) {
  v <- numbers(w)
  k <- v[6]
  values <- as.character(seq_len(k))
  parameters <- list(names = "x", isFixed = FALSE, types = list(x = "c"), domain = list(x = values), nbVariable = v[4],
                     names_variable = "x", get = function(name) list(type = "c", domain = values))
  elites <- data.frame(.ID. = 1, x = values[v[5]], .PARENT. = NA, stringsAsFactors = FALSE)
  model <- irace:::updateModel(parameters, elites, list(x = list("1" = v[7:(6 + k)])), v[2], v[3], 10,
                               if (is_4) v[1] != 0 else list(elitist = v[1] != 0))
  text(model$x[["1"]])
}

draws <- function(w) {
  type <- w[1]; v <- numbers(w[-1])
  lower <- v[1]; upper <- v[2]; value <- v[3]; n <- v[5]
  set.seed(v[6])
  is_log <- grepl("log", type); is_real <- substr(type, 1, 1) == "r"
  first <- if (is_log) 0.5 else (upper - lower) / 2
  sd <- first * v[4]
  top <- if (is_real) upper else upper + 1
  mean <- if (is_real) value else value + 0.5
  if (is_log) {
    # Its parameter file knows the logarithms of the bounds.
    line <- sprintf('x "" %s (%.17g, %.17g)', type, lower, upper)
    read <- readParameters(text = line)
    log <- if (is_4) read$get("x")[["transform"]] else read$transform$x
    mean <- if (is_4) irace:::transform_to_log(mean, log) else irace:::transform.to.log(mean, log, lower, top)
    x <- of_irace("transform.from.log", "transform_from_log")(irace:::rtnorm(n, mean, sd, 0, 1), log, lower, top)
  } else {
    x <- irace:::rtnorm(n, mean, sd, lower, top)
  }
  if (is_real) {
    x <- round(x, 4)
    bin <- pmin(8, floor((x - lower) / ((upper - lower) / 8)) + 1)
    return(text(tabulate(bin, 8)))
  }
  text(tabulate(pmin(floor(x), upper) - lower + 1, upper - lower + 1))
}

expression_value <- function(line) {
  w <- strsplit(line, " +")[[1]]
  environment <- list(a = if (w[2] == "NA") NA_character_ else w[2],
                      b = if (w[3] == "NA") NA_character_ else w[3],
                      c = if (w[4] == "NA") NA_integer_ else as.integer(w[4]),
                      d = if (w[5] == "NA") NA_real_ else as.numeric(w[5]))
  value <- eval(parse(text = paste(w[-(1:5)], collapse = " ")), environment)
  if (length(value) != 1 || is.na(value)) return("NA")
  if (is.character(value)) value else text(value)
}

answer <- function(line) {
  w <- strsplit(line, " +")[[1]]
  kind <- w[1]; w <- w[-1]
  switch(kind,
         eliminate = eliminate(w), agreement = agreement(w), overall = overall(w), size = race_size(w),
         minimum = minimum(w), update = update(w), draws = draws(w), expression = expression_value(line),
         rank = text(rank(numbers(w[-1]))),
         round = text(round(numbers(w[2]), numbers(w[1]))),
         text = format(numbers(w[1]), digits = 15, scientific = FALSE),
         adjust = text(p.adjust(numbers(w[-(1:2)]), method = w[1])),
         stop("unknown kind ", kind))
}

for (line in readLines(commandArgs(trailingOnly = TRUE)[1])) {
  cat(tryCatch(answer(line), error = function(e) paste("error:", gsub("\n", " ", conditionMessage(e)))), "\n", sep = "")
}
