;;; swarm-mode.el --- Models of swarms of robots  -*- lexical-binding: t; -*-

;; Package-Requires: ((emacs "27.1"))
;; Keywords: languages

;;; Commentary:

;; Colours, comments and indentation for .swarm files, and `swarmc lsp' for Eglot.

;;; Code:

(defgroup swarm nil
  "Models of swarms of robots."
  :group 'languages)

(defcustom swarm-indent-offset 2
  "By how many columns a block is indented."
  :type 'integer
  :safe #'integerp)

(defconst swarm--keywords
  '("action" "actuator" "after" "behavior" "choice" "communication" "connect" "const"
    "controller" "do" "done" "else" "endless" "entry" "enum" "environment" "event" "exit"
    "extends" "final" "fitness" "function" "gives" "history" "import" "in" "initial" "inout"
    "member" "message" "monitor" "on" "operation" "optimize" "out" "package" "parallel" "param"
    "region" "send" "sensor" "service" "state" "statemachine" "struct" "swarm" "type" "var"
    "virtual" "and" "not" "or")
  "Words that are names nowhere.")

(defconst swarm--constants '("aborted" "preempted" "succeeded" "false" "true"))

(defconst swarm--types
  '("bool" "byte" "char" "duration" "float32" "float64" "int8" "int16" "int32" "int64" "string"
    "time" "uint8" "uint16" "uint32" "uint64" "wstring"))

(defconst swarm--contextual
  '(("\\_<internal\\_>[ \t]+\\(?:on\\|after\\|monitor\\)" . "\\_<internal\\_>")
    ("(\\s-*by\\_>\\|\\_<gives\\s-+by\\_>" . "\\_<by\\_>")
    ("\\_<deep\\_>[ \t]+history" . "\\_<deep\\_>")
    ("\\_<\\(?:goal\\|result\\|feedback\\|request\\|response\\)\\_>\\s-*{"
     . "\\_<\\(?:goal\\|result\\|feedback\\|request\\|response\\)\\_>")
    (":\\s-*abstraction\\_>\\s-*{" . "\\_<abstraction\\_>")
    ("\\_<import\\s-+ros\\s-*\"" . "\\_<ros\\_>")
    ("^\\s-*\\(?:maximize\\|minimize\\|steps\\|evaluations\\|seed\\)\\s-+[-(0-9A-Za-z]"
     . "\\_<\\(?:maximize\\|minimize\\|steps\\|evaluations\\|seed\\)\\_>")
    ("\\_<count\\s-+of\\_>" . "\\_<count\\s-+of\\_>")
    ("\\_<step\\s-+[-(0-9A-Za-z]" . "\\_<step\\_>")
    ("^\\s-*\\(?:world\\s-*\"\\|size\\s-+[0-9]\\)" . "\\_<\\(?:world\\|size\\)\\_>")
    ("[kcm]?m\\s-+x\\s-+[0-9]" . "\\_<x\\_>"))
  "Words that are keywords at some places: what such a place looks like, and the word in it.")

(defun swarm--contextual (place word)
  "Colour what matches WORD where PLACE does."
  `(,place (0 (save-match-data
                (let ((end (match-end 0)))
                  (goto-char (match-beginning 0))
                  (when (re-search-forward ,word end t)
                    (put-text-property (match-beginning 0) (match-end 0)
                                       'face 'font-lock-keyword-face))
                  (goto-char end)
                  nil)))))

(defconst swarm--font-lock
  `(("\\.\\(done\\)\\_>" 1 font-lock-keyword-face)
    ;; A field may have the name of a keyword.
    ("\\.[ \t]*\\([A-Za-z_][A-Za-z0-9_]*\\)" 1 font-lock-variable-name-face)
    ("\\_<\\(?:statemachine\\|state\\|region\\|choice\\|final\\|history\\|member\\|sensor\\|actuator\\|controller\\|virtual\\|struct\\|enum\\|event\\|fitness\\|environment\\)[ \t]+\\([A-Za-z_][A-Za-z0-9_]*\\)"
     1 font-lock-type-face)
    ("\\_<\\(?:function\\|do\\)[ \t]+\\([A-Za-z_][A-Za-z0-9_.]*\\)" 1 font-lock-function-name-face)
    ("\\(?:[ \t]\\|[({,]\\s-*\\)\\([A-Za-z_][A-Za-z0-9_]*\\)[ \t]*\\(?::\\|=>\\|=[^=]\\)"
     1 font-lock-variable-name-face)
    ("\\_<[A-Za-z_][A-Za-z0-9_]*/[A-Za-z_][A-Za-z0-9_]*\\_>" . font-lock-type-face)
    ,@(mapcar (lambda (each) (swarm--contextual (car each) (cdr each))) swarm--contextual)
    (,(regexp-opt swarm--types 'symbols) . font-lock-type-face)
    (,(regexp-opt swarm--constants 'symbols) . font-lock-constant-face)
    (,(regexp-opt swarm--keywords 'symbols) . font-lock-keyword-face)))

(defvar swarm-mode-syntax-table
  (let ((table (make-syntax-table)))
    (modify-syntax-entry ?/ ". 124b" table)
    (modify-syntax-entry ?* ". 23" table)
    (modify-syntax-entry ?\n "> b" table)
    (modify-syntax-entry ?_ "_" table)
    (modify-syntax-entry ?\" "\"" table)
    table))

(defun swarm-indent-line ()
  "Indent a line by the blocks around it."
  (interactive)
  (let ((depth (save-excursion
                 (beginning-of-line)
                 (- (car (syntax-ppss)) (if (looking-at "[ \t]*[]})]") 1 0)))))
    (save-excursion (indent-line-to (* swarm-indent-offset (max depth 0))))
    (when (< (current-column) (current-indentation))
      (back-to-indentation))))

;;;###autoload
(define-derived-mode swarm-mode prog-mode "Swarm"
  "Models of swarms of robots."
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
