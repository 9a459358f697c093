" Colours for .swarm files. Words that are keywords at some places only are coloured there.
if exists("b:current_syntax")
  finish
endif

syn keyword swarmDeclaration action actuator behavior choice communication connect const controller
syn keyword swarmDeclaration entry enum environment event exit extends final fitness function history
syn keyword swarmDeclaration in initial inout member message operation optimize out parallel param
syn keyword swarmDeclaration region sensor service state statemachine struct swarm type var virtual
syn keyword swarmDeclaration endless
syn keyword swarmStatement after do done else gives monitor on send
syn keyword swarmInclude import package
syn keyword swarmOutcome aborted preempted succeeded
syn keyword swarmOperator and not or
syn keyword swarmBoolean false true
syn keyword swarmType bool byte char duration float32 float64 int8 int16 int32 int64
syn keyword swarmType string time uint8 uint16 uint32 uint64 wstring

" Such words may be names elsewhere.
syn match swarmStatement "\<internal\>\ze\s\+\%(on\|after\|monitor\)\>"
syn match swarmStatement "(\s*\zsby\>"
syn match swarmStatement "\%(\<gives\s\+\)\@<=by\>"
syn match swarmDeclaration "\<deep\>\ze\s\+history\>"
syn match swarmDeclaration "\<\%(goal\|result\|feedback\|request\|response\)\>\ze\s*{"
syn match swarmDeclaration ":\s*\zs\%(abstraction\|swarm\)\>\ze\s*{"
syn match swarmInclude "\%(\<import\s\+\)\@<=ros\>\ze\s*\""
syn match swarmStatement "^\s*\zs\%(maximize\|minimize\)\>"
syn match swarmStatement "^\s*\zs\%(steps\|evaluations\|seed\)\>\ze\s\+[0-9(A-Za-z]"
syn match swarmStatement "\<count\s\+of\>"
syn match swarmStatement "\<step\>\ze\s\+[-0-9(A-Za-z]"
syn match swarmStatement "^\s*\zs\%(world\s*\ze\"\|size\ze\s\+\d\)"
syn match swarmStatement "\%(\<\%(km\|cm\|mm\|m\)\s\+\)\@<=x\>\ze\s\+\d"

syn match swarmType "\<\h\w*/\h\w*\>"
syn match swarmFunction "\%(\<\%(function\|do\)\)\@<=\s\+\h[A-Za-z0-9_.]*"
syn match swarmArrow "->\|=>"
" A field of any name: the word behind a dot, or before a colon or an equals sign, is none.
syn match swarmField "\.\s*\%(done\>\)\@!\h\w*"
syn match swarmField "\%(\s\|[({,]\_s*\)\h\w*\ze\s*\%(:\|=>\|=[^=]\)"
syn match swarmName "\%(\<\%(statemachine\|state\|region\|choice\|final\|history\|member\|sensor\|actuator\|controller\|virtual\|struct\|enum\|event\|fitness\|environment\)\)\@<=\s\+\h\w*"

syn match swarmNumber "\<\d\+\%(\.\d\+\)\=\%([eE][+-]\=\d\+\)\=\%(\s*\%(us\|ms\|s\|min\|h\|km\|cm\|mm\|m\)\>\)\="
syn match swarmEscape "\\." contained
syn region swarmString start=+"+ skip=+\\.+ end=+"+ oneline contains=swarmEscape,@Spell
syn keyword swarmTodo TODO FIXME XXX contained
syn match swarmComment "//.*$" contains=swarmTodo,@Spell
syn match swarmDoc "^\s*\zs///\%([^/].*\)\=$" contains=@Spell
syn region swarmComment start="/\*" end="\*/" contains=swarmTodo,@Spell

hi def link swarmDeclaration Keyword
hi def link swarmStatement Statement
hi def link swarmInclude Include
hi def link swarmOutcome Constant
hi def link swarmOperator Operator
hi def link swarmArrow Operator
hi def link swarmBoolean Boolean
hi def link swarmType Type
hi def link swarmFunction Function
hi def link swarmName Identifier
hi def link swarmNumber Number
hi def link swarmString String
hi def link swarmEscape SpecialChar
hi def link swarmComment Comment
hi def link swarmDoc SpecialComment
hi def link swarmTodo Todo

let b:current_syntax = "swarm"
