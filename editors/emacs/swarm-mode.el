;;; swarm-mode.el --- Major mode for swarm models  -*- lexical-binding: t; -*-

;; Package-Requires: ((emacs "27.1"))
;; Keywords: languages

;;; Commentary:

;; Highlighting, comments and indentation for .swarm files, and `swarmc lsp' for Eglot.

;;; Code:

(defgroup swarm nil
  "Major mode for swarm models."
  :group 'languages)

(defcustom swarm-indent-offset 2
  "Number of columns to indent a block."
  :type 'integer
  :safe #'integerp)

;; made by `make parser`
(defconst swarm--keywords
  '("action" "actuator" "after" "and" "behavior" "choice" "communication" "connect" "const"
    "controller" "do" "done" "else" "endless" "entry" "enum" "environment" "event" "exit"
    "extends" "final" "fitness" "function" "gives" "history" "import" "in" "initial" "inout"
    "member" "message" "monitor" "not" "on" "operation" "optimize" "or" "out" "package" "parallel"
    "param" "property" "region" "self" "send" "sensor" "service" "state" "statemachine" "struct"
    "swarm" "type" "var" "virtual")
  "Words that cannot be names.")

(defconst swarm--constants
  '("aborted" "false" "preempted" "succeeded" "true"))

(defconst swarm--types
  '("bool" "byte" "char" "int8" "uint8" "int16" "uint16" "int32" "uint32" "int64" "uint64"
    "float32" "float64" "string" "wstring" "time" "duration"))

(defconst swarm--naming
  '("actuator" "choice" "communication" "const" "controller" "enum" "environment" "event" "final"
    "fitness" "history" "member" "model" "operation" "property" "region" "sensor" "state"
    "statemachine" "struct" "type" "virtual")
  "Words that the name of a new element follows.")

(defconst swarm--contextual
  '("\\_<\\(abstraction\\)\\_>[ \t]*[{]"
    "\\_<\\(again\\)\\_>[ \t]*[(*A-Za-z_0-9\"]"
    "\\_<\\(all\\)\\_>[ \t]*[A-Za-z_]"
    "\\_<\\(always\\)\\_>[ \t]*\\(?:possible\\)\\_>"
    "\\_<\\(append\\)\\_>[ \t]*[A-Za-z_0-9\"-]"
    "\\_<\\(area\\)\\_>[ \t]*[A-Za-z_]"
    "\\_<\\(as\\)\\_>[ \t]*[A-Za-z_]"
    "\\_<\\(at\\)\\_>[ \t]*\\(?:\\(?:all\\|least\\|most\\|random\\)\\_>\\|[(]\\)"
    "\\_<\\(battery\\)\\_>[ \t]*[{]"
    "\\_<\\(before\\)\\_>[ \t]*[(*A-Za-z_0-9\"]"
    "\\_<\\(best\\)\\_>[ \t]*\\(?:effort\\)\\_>"
    "\\_<\\(between\\)\\_>[ \t]*[(*A-Za-z_0-9\"]"
    "\\_<\\(body\\)\\_>[ \t]*[{]"
    "\\_<\\(by\\)\\_>[ \t]*[A-Za-z_0-9\"-]"
    "\\_<\\(call\\)\\_>[ \t]*[A-Za-z_]"
    "\\_<\\(cancel\\)\\_>[ \t]*[A-Za-z_]"
    "\\_<\\(cancels\\)\\_>[ \t]*[A-Za-z_]"
    "\\_<\\(clear\\)\\_>[ \t]*[A-Za-z_0-9\"-]"
    "\\_<\\(contract\\)\\_>[ \t]*[A-Za-z_]"
    "\\_<\\(count\\)\\_>[ \t]*\\(?:\\(?:of\\)\\_>\\|[(]\\)"
    "\\_<\\(covered\\)\\_>[ \t]*[(]"
    "\\_<\\(dead\\)\\_>[ \t]*\\(?:call\\)\\_>"
    "\\_<\\(deadline\\)\\_>[ \t]*[A-Za-z_0-9\"-]"
    "\\_<\\(deep\\)\\_>[ \t]*\\(?:history\\)\\_>"
    "\\_<\\(defer\\)\\_>[ \t]*[A-Za-z_]"
    "\\_<\\(distance\\)\\_>[ \t]*[(]"
    "\\_<\\(each\\)\\_>[ \t]*[A-Za-z_]"
    "\\_<\\(effort\\)\\_>[ \t]*\\(?:[,;}]\\|$\\)"
    "\\_<\\(ends\\)\\_>[ \t]*[A-Za-z_]"
    "\\_<\\(energy\\)\\_>[ \t]*[(]"
    "\\_<\\(evaluations\\)\\_>[ \t]*[A-Za-z_0-9\"-]"
    "\\_<\\(eventually\\)\\_>[ \t]*[(*A-Za-z_0-9\"]"
    "\\_<\\(feedback\\)\\_>[ \t]*[{]"
    "\\_<\\(found\\)\\_>[ \t]*[(]"
    "\\_<\\(from\\)\\_>[ \t]*[A-Za-z_0-9\"-]"
    "\\_<\\(goal\\)\\_>[ \t]*[{]"
    "\\_<\\(has\\)\\_>[ \t]*[\\[]"
    "\\_<\\(hears\\)\\_>[ \t]*[A-Za-z_]"
    "\\_<\\(heartbeat\\)\\_>[ \t]*[A-Za-z_0-9\"-]"
    "\\_<\\(height\\)\\_>[ \t]*[A-Za-z_0-9\"-]"
    "\\_<\\(internal\\)\\_>[ \t]*\\(?:\\(?:after\\|monitor\\|on\\)\\_>\\|[\\[]\\)"
    "\\_<\\(keep\\)\\_>[ \t]*[A-Za-z_0-9\"-]"
    "\\_<\\(latest\\)\\_>[ \t]*\\(?:[,;}]\\|$\\)"
    "\\_<\\(leads\\)\\_>[ \t]*\\(?:to\\)\\_>"
    "\\_<\\(least\\)\\_>[ \t]*[0-9\"]"
    "\\_<\\(lifespan\\)\\_>[ \t]*[A-Za-z_0-9\"-]"
    "\\_<\\(lost\\)\\_>[ \t]*\\(?:after\\)\\_>"
    "\\_<\\(max\\)\\_>[ \t]*\\(?:count\\|each\\)\\_>"
    "\\_<\\(maximize\\)\\_>[ \t]*[A-Za-z_0-9\"-]"
    "\\_<\\(mean\\)\\_>[ \t]*\\(?:count\\|each\\)\\_>"
    "\\_<\\(min\\)\\_>[ \t]*\\(?:count\\|each\\)\\_>"
    "\\_<\\(minimize\\)\\_>[ \t]*[A-Za-z_0-9\"-]"
    "\\_<\\(model\\)\\_>[ \t]*[A-Za-z_]"
    "\\_<\\(most\\)\\_>[ \t]*[0-9\"]"
    "\\_<\\(neighbors\\)\\_>[ \t]*\\(?:within\\)\\_>"
    "\\_<\\(never\\)\\_>[ \t]*[(*A-Za-z_0-9\"]"
    "\\_<\\(no\\)\\_>[ \t]*[A-Za-z_]"
    "\\_<\\(obstacle\\)\\_>[ \t]*[A-Za-z_]"
    "\\_<\\(of\\)\\_>[ \t]*[A-Za-z_]"
    "\\_<\\(only\\)\\_>[ \t]*\\(?:after\\)\\_>"
    "\\_<\\(operator\\)\\_>[ \t]*\\(?:event\\)\\_>"
    "\\_<\\(other\\)\\_>[ \t]*[A-Za-z_]"
    "\\_<\\(possible\\)\\_>[ \t]*[(*A-Za-z_0-9\"]"
    "\\_<\\(radio\\)\\_>[ \t]*[{]"
    "\\_<\\(radius\\)\\_>[ \t]*[A-Za-z_0-9\"-]"
    "\\_<\\(rain\\)\\_>[ \t]*\\(?:from\\|until\\)\\_>"
    "\\_<\\(random\\)\\_>[ \t]*\\(?:in\\)\\_>"
    "\\_<\\(reach\\)\\_>[ \t]*[A-Za-z_]"
    "\\_<\\(reliable\\)\\_>[ \t]*\\(?:[,;}]\\|$\\)"
    "\\_<\\(remove\\)\\_>[ \t]*[A-Za-z_0-9\"-]"
    "\\_<\\(request\\)\\_>[ \t]*[{]"
    "\\_<\\(response\\)\\_>[ \t]*[{]"
    "\\_<\\(result\\)\\_>[ \t]*[{]"
    "\\_<\\(ros\\)\\_>[ \t]*[0-9\"]"
    "\\_<\\(seed\\)\\_>[ \t]*[A-Za-z_0-9\"-]"
    "\\_<\\(sends\\)\\_>[ \t]*[A-Za-z_]"
    "\\_<\\(senses\\)\\_>[ \t]*[A-Za-z_]"
    "\\_<\\(size\\)\\_>[ \t]*[0-9\"]"
    "\\_<\\(some\\)\\_>[ \t]*[A-Za-z_]"
    "\\_<\\(starts\\)\\_>[ \t]*[A-Za-z_]"
    "\\_<\\(step\\)\\_>[ \t]*[A-Za-z_0-9\"-]"
    "\\_<\\(steps\\)\\_>[ \t]*[A-Za-z_0-9\"-]"
    "\\_<\\(subject\\)\\_>[ \t]*\\(?:to\\)\\_>"
    "\\_<\\(sum\\)\\_>[ \t]*\\(?:each\\)\\_>"
    "\\_<\\(target\\)\\_>[ \t]*[A-Za-z_]"
    "\\_<\\(then\\)\\_>[ \t]*[(*A-Za-z_0-9\"]"
    "\\_<\\(time\\)\\_>[ \t]*\\(?:\\(?:until\\)\\_>\\|[(]\\)"
    "\\_<\\(times\\)\\_>[ \t]*\\(?:[,;}]\\|$\\)"
    "\\_<\\(to\\)\\_>[ \t]*[(*A-Za-z_0-9\"-]"
    "\\_<\\(total\\)\\_>[ \t]*[(]"
    "\\_<\\(until\\)\\_>[ \t]*[(*A-Za-z_0-9\"-]"
    "\\_<\\(wall\\)\\_>[ \t]*[:]"
    "\\_<\\(when\\)\\_>[ \t]*\\(?:dead\\)\\_>"
    "\\_<\\(where\\)\\_>[ \t]*[A-Za-z_0-9\"-]"
    "\\_<\\(wind\\)\\_>[ \t]*[A-Za-z_0-9\"-]"
    "\\_<\\(within\\)\\_>[ \t]*[A-Za-z_0-9\"-]"
    "\\_<\\(world\\)\\_>[ \t]*[0-9\"]"
    "\\_<\\(x\\)\\_>[ \t]*[0-9\"]"
    "\\_<\\(zone\\)\\_>[ \t]*[A-Za-z_]")
  "Words that are keywords only before certain others.")
;; end

(defun swarm--escape (limit)
  "Find the next escape in a string, before LIMIT."
  (let (found)
    (while (and (setq found (re-search-forward
                             "\\\\\\(?:[\"\\\\nrt]\\|u[0-9A-Fa-f]\\{4\\}\\|U[0-9A-Fa-f]\\{8\\}\\)"
                             limit t))
                (not (nth 3 (save-excursion (syntax-ppss (match-beginning 0)))))))
    found))

(defconst swarm--font-lock
  `(("\\.\\(done\\)\\_>" 1 font-lock-keyword-face)
    ;; A field may have the name of a keyword.
    ("\\.[ \t]*\\([A-Za-z_][A-Za-z0-9_]*\\)" 1 font-lock-variable-name-face)
    ;; So may a port.
    ("\\_<connect[ \t]+\\([A-Za-z_][A-Za-z0-9_]*\\)[ \t]*->" 1 font-lock-variable-name-face)
    ("\\_<connect\\_>.*->[ \t]*\\([A-Za-z_][A-Za-z0-9_]*\\)[ \t]*\\(?:$\\|[;}/]\\)"
     1 font-lock-variable-name-face)
    (,(concat (regexp-opt swarm--naming 'symbols) "[ \t]+\\([A-Za-z_][A-Za-z0-9_]*\\)")
     2 font-lock-type-face)
    ("\\_<\\(?:function\\|do\\)[ \t]+\\([A-Za-z_][A-Za-z0-9_.]*\\)" 1 font-lock-function-name-face)
    ;; A wall has no name.
    ("\\_<\\(wall\\)[ \t]*:[ \t]*(" 1 font-lock-keyword-face)
    ("\\(?:[ \t]\\|[({,]\\s-*\\)\\([A-Za-z_][A-Za-z0-9_]*\\)[ \t]*\\(?::\\|=>\\|=[^=]\\)"
     1 font-lock-variable-name-face)
    ("\\_<[A-Za-z_][A-Za-z0-9_]*/[A-Za-z_][A-Za-z0-9_]*\\_>" . font-lock-type-face)
    ,@(mapcar (lambda (regexp) `(,regexp 1 font-lock-keyword-face)) swarm--contextual)
    (,(regexp-opt swarm--types 'symbols) . font-lock-type-face)
    (,(regexp-opt swarm--constants 'symbols) . font-lock-constant-face)
    (,(regexp-opt swarm--keywords 'symbols) . font-lock-keyword-face)
    (swarm--escape 0 font-lock-constant-face prepend)))

(defvar swarm-mode-syntax-table
  (let ((table (make-syntax-table)))
    (modify-syntax-entry ?/ ". 124b" table)
    (modify-syntax-entry ?* ". 23" table)
    (modify-syntax-entry ?\n "> b" table)
    (modify-syntax-entry ?_ "_" table)
    (modify-syntax-entry ?\" "\"" table)
    table))

(defun swarm-indent-line ()
  "Indent the current line by its enclosing blocks."
  (interactive)
  (let ((depth (save-excursion
                 (beginning-of-line)
                 (- (car (syntax-ppss)) (if (looking-at "[ \t]*[]})]") 1 0)))))
    (save-excursion (indent-line-to (* swarm-indent-offset (max depth 0))))
    (when (< (current-column) (current-indentation))
      (back-to-indentation))))

;;;###autoload
(define-derived-mode swarm-mode prog-mode "Swarm"
  "Major mode for swarm models."
  (setq-local comment-start "// "
              comment-start-skip "\\(?://+\\|/\\*+\\)[ \t]*"
              comment-end ""
              indent-line-function #'swarm-indent-line
              indent-tabs-mode nil
              font-lock-defaults '(swarm--font-lock)))

;;;###autoload
(add-to-list 'auto-mode-alist '("\\.swarm\\'" . swarm-mode))

(defvar eglot-server-programs)
(with-eval-after-load 'eglot
  (add-to-list 'eglot-server-programs '(swarm-mode . ("swarmc" "lsp"))))

(provide 'swarm-mode)
;;; swarm-mode.el ends here
